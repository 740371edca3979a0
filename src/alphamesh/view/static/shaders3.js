// Shaders of the picture in space.

const CUT = `
uniform vec4 uCut;
void keep(vec3 p) { if (dot(uCut.xyz, p) > uCut.w) discard; }
`;

export const SURFACE_VERTEX = `
layout(location = 0) in vec3 aPlace;
uniform mat4 uMatrix;
out vec3 vPlace;
out vec3 vCorner;
void main() {
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  vPlace = aPlace;
  gl_Position = uMatrix * vec4(aPlace, 1.0);
}
`;

// Outside is lit. Inside, seen only behind the cut, is flat: it looks as if filled.
export const SURFACE_FRAGMENT = `${CUT}
uniform vec3 uOutside;
uniform vec3 uInside;
uniform vec3 uWire;
uniform vec3 uLight;
uniform vec3 uBack;
uniform float uWidth;
uniform bool uBothSides;
in vec3 vPlace;
in vec3 vCorner;
out vec4 colour;
void main() {
  keep(vPlace);
  vec3 normal = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  if (dot(normal, uBack) < 0.0) normal = -normal;
  float shade = 0.5 + 0.5 * max(dot(normal, uLight), 0.0);
  bool outside = uBothSides || gl_FrontFacing;
  vec3 base = outside ? uOutside * shade : uInside;
  vec3 pixels = vCorner / max(fwidth(vCorner), vec3(1e-6));
  float line = outside ? clamp(uWidth - min(min(pixels.x, pixels.y), pixels.z), 0.0, 1.0) : 0.0;
  colour = vec4(mix(base, uWire, 0.55 * line), 1.0);
}
`;

export const LINE_VERTEX = `
layout(location = 0) in vec3 aPlace;
uniform mat4 uMatrix;
out vec3 vPlace;
void main() {
  vPlace = aPlace;
  gl_Position = uMatrix * vec4(aPlace, 1.0);
}
`;

export const LINE_FRAGMENT = `${CUT}
uniform vec3 uColour;
in vec3 vPlace;
out vec4 colour;
void main() {
  keep(vPlace);
  colour = vec4(uColour, 1.0);
}
`;

export const BALL_VERTEX = `
layout(location = 0) in vec3 aPlace;
layout(location = 1) in uint aJoined;
uniform mat4 uMatrix;
uniform uint uEdges;
uniform vec3 uColours[2];
uniform vec2 uSizes;
uniform float uPixels;
out vec3 vPlace;
flat out vec3 vColour;
void main() {
  bool isolated = aJoined >= uEdges;
  vColour = uColours[isolated ? 1 : 0];
  vPlace = aPlace;
  gl_Position = uMatrix * vec4(aPlace, 1.0);
  float size = isolated ? uSizes.y : uSizes.x;
  gl_PointSize = max(uPixels * size / gl_Position.w, isolated ? 2.5 : 1.5);
  if (size == 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

// A point is a small ball, lit from the same side as the surface.
export const BALL_FRAGMENT = `${CUT}
uniform vec3 uLightSeen;
in vec3 vPlace;
flat in vec3 vColour;
out vec4 colour;
void main() {
  keep(vPlace);
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  float inside = 1.0 - dot(place, place);
  if (inside < 0.0) discard;
  vec3 normal = vec3(place.x, -place.y, sqrt(inside));
  colour = vec4(vColour * (0.6 + 0.4 * max(dot(normal, uLightSeen), 0.0)), 1.0);
}
`;
