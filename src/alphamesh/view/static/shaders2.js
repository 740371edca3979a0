// Shaders of the picture in the plane.

const VIEW = `
uniform vec2 uCenter;
uniform vec2 uScale;
vec4 seen(vec2 p, float depth) { return vec4((p - uCenter) * uScale, depth, 1.0); }
const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
`;

export const FILL_VERTEX = `${VIEW}
layout(location = 0) in vec2 aPlace;
void main() { gl_Position = seen(aPlace, 0.0); }
`;

export const FILL_FRAGMENT = `
uniform vec4 uColour;
out vec4 colour;
void main() { colour = uColour; }
`;

// Edges inside: what is inside follows from how many triangles there are and from the rank
// of the last triangle of the edge.
export const INNER_VERTEX = `${VIEW}
layout(location = 0) in vec2 aPlace;
layout(location = 1) in uint aLast;
uniform uint uTriangles;
uniform vec3 uColour;
flat out vec3 vColour;
void main() {
  vColour = uColour;
  gl_Position = aLast < uTriangles ? seen(aPlace, 0.0) : NOWHERE;
}
`;

// A line with a width is two triangles, longer than the edge by half the width at each end.
export const EDGE_VERTEX = `${VIEW}
layout(location = 0) in vec2 aStart;
layout(location = 1) in vec2 aEnd;
uniform float uWidth;
uniform vec3 uColour;
uniform vec2 uSize;
flat out vec3 vColour;
void main() {
  int corner = gl_VertexID % 6;
  bool atEnd = corner == 2 || corner == 4 || corner == 5;
  bool left = corner == 1 || corner == 2 || corner == 4;
  vColour = uColour;
  vec2 a = (aStart - uCenter) * uScale;
  vec2 b = (aEnd - uCenter) * uScale;
  vec2 along = (b - a) * uSize;
  along *= uWidth / max(length(along), 1e-6);
  vec2 across = vec2(-along.y, along.x);
  vec2 place = atEnd ? b + along / uSize : a - along / uSize;
  gl_Position = vec4(place + (left ? across : -across) / uSize, 0.0, 1.0);
}
`;

export const EDGE_FRAGMENT = `
flat in vec3 vColour;
out vec4 colour;
void main() { colour = vec4(vColour, 1.0); }
`;

export const POINT_VERTEX = `${VIEW}
layout(location = 0) in vec2 aPlace;
layout(location = 1) in uint aJoined;
uniform uint uEdges;
uniform vec2 uSizes;
uniform vec3 uColours[2];
flat out vec3 vColour;
flat out float vSize;
void main() {
  bool isolated = aJoined >= uEdges;
  vColour = uColours[isolated ? 1 : 0];
  vSize = isolated ? uSizes.y : uSizes.x;
  gl_Position = vSize == 0.0 ? NOWHERE : seen(aPlace, 0.0);
  gl_PointSize = vSize + 1.0;
}
`;

export const POINT_FRAGMENT = `
flat in vec3 vColour;
flat in float vSize;
out vec4 colour;
void main() {
  float away = length(gl_PointCoord - 0.5) * (vSize + 1.0);
  float cover = clamp(0.5 * vSize - away + 0.5, 0.0, 1.0);
  if (cover == 0.0) discard;
  colour = vec4(vColour, cover);
}
`;

// Two triangles: an end of an edge, and the ridge between the cells of both ends. They are
// read from a texture, as many small instances are slow where there is no GPU.
export const CELL_VERTEX = `${VIEW}
uniform highp sampler2D uPieces;
uniform vec3 uCells[7];
uniform int uTexels; // of a piece: with weights, the last one holds the tips
uniform float uPower;
flat out vec2 vSite;
flat out float vRadius;
flat out vec3 vRidge;
flat out vec3 vColour;
void main() {
  int piece = gl_VertexID / 6;
  int each = 2048 / uTexels;
  ivec2 at = ivec2(uTexels * (piece % each), piece / each);
  vec4 sites = texelFetch(uPieces, at, 0);
  vec4 ridge = texelFetch(uPieces, at + ivec2(1, 0), 0);
  vec4 colours = texelFetch(uPieces, at + ivec2(2, 0), 0);
  vec4 tips = uTexels == 4 ? texelFetch(uPieces, at + ivec2(3, 0), 0) : sites;
  bool second = gl_VertexID % 6 >= 3;
  vSite = second ? sites.zw : sites.xy;
  vec2 step = second ? sites.xy - sites.zw : sites.zw - sites.xy;
  float wide = length(step);
  vec2 weights = second ? colours.wz : colours.zw;
  float away = 0.5 * wide + 0.5 * (weights.x - weights.y) / wide;
  // Seen from the site: the direction of the ridge, and how far it is; none in a sector.
  vRidge = wide > 0.0 ? vec3(step / wide, away) : vec3(0, 0, 1e9);
  vRadius = sqrt(max(0.0, weights.x + uPower));
  vColour = uCells[int(second ? colours.y : colours.x)];
  int corner = gl_VertexID % 3;
  vec2 tip = second ? tips.zw : tips.xy;
  gl_Position = seen(corner == 0 ? tip : corner == 1 ? ridge.xy : ridge.zw, 0.0);
  if (vRadius == 0.0) gl_Position = NOWHERE;
}
`;

export const CELL_FRAGMENT = `
uniform vec2 uCenter;
uniform vec2 uSize;
uniform float uPixels;
uniform vec2 uWidths;
uniform vec3 uRidge;
uniform vec3 uArc;
flat in vec2 vSite;
flat in float vRadius;
flat in vec3 vRidge;
flat in vec3 vColour;
out vec4 colour;
void main() {
  // From the pixel itself: corners far away would leave too few digits.
  vec2 offset = (gl_FragCoord.xy - 0.5 * uSize) / uPixels + uCenter - vSite;
  float inside = (vRadius - length(offset)) * uPixels;
  if (inside < -0.5) discard;
  float ridge = (vRidge.z - dot(offset, vRidge.xy)) * uPixels;
  vec3 shade = mix(vColour, uRidge, min(1.0, uWidths.x) * clamp(uWidths.x - ridge + 0.5, 0.0, 1.0));
  float arc = min(1.0, uWidths.y) * clamp(uWidths.y - inside + 0.5, 0.0, 1.0);
  colour = vec4(mix(shade, uArc, arc), clamp(inside + 0.5, 0.0, 1.0));
}
`;

// All chords of all circles, one after the other.
export const CIRCLE_VERTEX = `${VIEW}
uniform highp sampler2D uSites; // places and weights
uniform float uPower;
uniform int uCorners;
uniform vec3 uColour;
flat out vec3 vColour;
void main() {
  int chord = gl_VertexID / 2;
  int site = chord / uCorners;
  int corner = chord % uCorners + gl_VertexID % 2;
  float angle = 6.28318530718 * float(corner) / float(uCorners);
  vec4 ball = texelFetch(uSites, ivec2(site % 2048, site / 2048), 0);
  float radius = sqrt(max(0.0, ball.z + uPower));
  vColour = uColour;
  gl_Position = seen(ball.xy + radius * vec2(cos(angle), sin(angle)), 0.0);
  if (radius == 0.0) gl_Position = NOWHERE;
}
`;
