// Stands in for a user's light shader (Light::shader), whose file takes the place of this one. It defines
// user_light: a factor on the light's intensity.
//   away        unit direction from the light in its own frame: x to the right, y up, z along its direction
//   distance    from the light [scene units]
//   parameters  parameter_1 .. parameter_8 of the lighting file; a single number is in all three components
vec3 user_light(vec3 away, float distance, vec3 parameters[8]) { return vec3(1.0); }
