// A light in rings around its axis. parameter_1: rings a radian; parameter_2: half-angle of the light in radians.
vec3 user_light(vec3 away, float distance, vec3 parameters[8]) {
  float angle = acos(clamp(away.z, -1.0, 1.0));
  float ring = 0.5 + 0.5 * cos(6.2831853 * parameters[0].x * angle);
  return vec3(ring * (1.0 - smoothstep(0.9 * parameters[1].x, parameters[1].x, angle)));
}
