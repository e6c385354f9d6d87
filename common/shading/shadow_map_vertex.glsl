// Depth of the scene as one face of a light's shadow map sees it. Positions are taken relative to the light before
// anything else, so that a scene far from the origin loses nothing.
layout(location = 0) in vec3 position;
uniform vec3 light_position;
uniform vec3 face_right, face_up, face_forward;
uniform float tan_half;
uniform float near_depth;
uniform int parallel;

void main() {
  vec3 rel = position - light_position;
  vec3 p = vec3(dot(face_right, rel), dot(face_up, rel), dot(face_forward, rel));
  if (parallel != 0) {
    gl_Position = vec4(p.xy / tan_half, 0.5 - 0.5 * p.z / near_depth, 1.0);
    return;
  }
  // z / w = near / depth: 1 at the near plane, towards 0 far away (reversed, clip control 0..1).
  gl_Position = vec4(p.xy / tan_half, near_depth, p.z);
}
