// Shaders of the picture in space.

const CUT = `
uniform vec4 uCut;
uniform vec3 uLow; // of a periodic box
uniform vec3 uHigh;
void keep(vec3 p) {
  if (dot(uCut.xyz, p) > uCut.w) discard;
  if (any(lessThan(p, uLow)) || any(greaterThan(p, uHigh))) discard;
}
// From where to where on its way a ray is in the box, and on this side of the cut.
vec2 kept(vec3 from, vec3 way) {
  vec3 safe = mix(way, vec3(1e-9), vec3(lessThan(abs(way), vec3(1e-9))));
  vec3 one = (uLow - from) / safe;
  vec3 two = (uHigh - from) / safe;
  vec3 enter = min(one, two);
  vec3 leave = max(one, two);
  vec2 span = vec2(max(max(enter.x, enter.y), enter.z), min(min(leave.x, leave.y), leave.z));
  float steep = dot(uCut.xyz, way);
  float height = uCut.w - dot(uCut.xyz, from);
  if (steep > 0.0) span.y = min(span.y, height / steep);
  else if (steep < 0.0) span.x = max(span.x, height / steep);
  else if (height < 0.0) span.y = -1e30;
  return span;
}
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
uniform float uFlat; // from 0, lit, to 1, the same from all sides
in vec3 vPlace;
in vec3 vCorner;
out vec4 colour;
void main() {
  keep(vPlace);
  vec3 normal = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  if (dot(normal, uBack) < 0.0) normal = -normal;
  float shade = 0.5 + 0.5 * max(dot(normal, uLight), 0.0);
  bool outside = uBothSides || gl_FrontFacing;
  vec3 base = mix(outside ? uOutside * shade : uInside, uInside, uFlat);
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

// A growing ball is a square that faces the eye; each of its pixels finds the ball itself.
export const GROWN_VERTEX = `
uniform highp sampler2D uSites; // places and weights
uniform float uPower;
uniform mat4 uMatrix;
uniform vec3 uEye;
out vec3 vOffset;
flat out vec4 vBall;
void main() {
  int site = gl_VertexID / 6;
  int corner = gl_VertexID % 6;
  vec4 ball = texelFetch(uSites, ivec2(site % 2048, site / 2048), 0);
  vBall = vec4(ball.xyz, sqrt(max(0.0, ball.w + uPower)));
  vec3 towards = uEye - vBall.xyz;
  float away = length(towards);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (vBall.w == 0.0 || away <= 1.001 * vBall.w) return;
  towards /= away;
  vec3 right = normalize(cross(abs(towards.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0), towards));
  vec3 up = cross(towards, right);
  // What is seen of a ball from near by is wider than the ball.
  float reach = vBall.w * away / sqrt(away * away - vBall.w * vBall.w);
  float x = corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0;
  float y = corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0;
  vOffset = reach * (x * right + y * up);
  gl_Position = uMatrix * vec4(vBall.xyz + vOffset, 1.0);
}
`;

export const GROWN_FRAGMENT = `${CUT}
uniform mat4 uMatrix;
uniform vec3 uEye;
uniform vec3 uLight;
uniform vec3 uOutside;
uniform vec3 uInside;
uniform float uOpacity;
in vec3 vOffset;
flat in vec4 vBall;
out vec4 colour;
void main() {
  vec3 way = normalize(vBall.xyz + vOffset - uEye);
  // Where the ray is nearest to the middle of the ball, seen from there.
  vec3 nearest = vOffset - dot(vOffset, way) * way;
  float half_square = vBall.w * vBall.w - dot(nearest, nearest);
  if (half_square < 0.0) discard;
  vec3 back = sqrt(half_square) * way;
  vec3 normal = (nearest - back) / vBall.w;
  vec3 place = vBall.xyz + nearest - back;
  float shade = 0.5 + 0.5 * max(dot(normal, uLight), 0.0);
  vec3 base = uOutside * shade;
  vec2 span = kept(place, way);
  if (span.x > min(span.y, 2.0 * length(back)) || span.y < 0.0) discard;
  if (span.x > 0.0) {
    // Where the ray enters what is left of the ball: on the cut.
    place += span.x * way;
    base = uInside;
  }
  vec4 seen = uMatrix * vec4(place, 1.0);
  gl_FragDepth = 0.5 * seen.z / seen.w + 0.5;
  colour = vec4(base, uOpacity);
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
