#include "balls3.hpp"

#include <algorithm>
#include <cmath>

namespace alphamesh {
namespace {

using Id = std::int32_t;
using Vector = Vector3<double>;

}  // namespace

Lens Balls3::lens(Id i, Id j) const {
  Lens out{};
  out.length = norm(place(j) - place(i));
  const double lean = (weight(i) - weight(j)) / out.length;
  out.from[0] = 0.5 * (out.length + lean);
  out.from[1] = 0.5 * (out.length - lean);
  // From the smaller ball, less cancels.
  const int k = square(i) <= square(j) ? 0 : 1;
  const double r = radius(k == 0 ? i : j), h = std::fabs(out.from[k]);
  out.circle = std::sqrt(std::max(0.0, (r - h) * (r + h)));
  return out;
}

// Angles come from the cosine and the sine of one half angle, that on the smallest circle:
// where two spheres hardly touch, errors of theirs cancel only if they are the same.
Flap Balls3::flap(const Id* corner) const {
  Flap out{};
  const Place3 p[3] = {place(corner[0]), place(corner[1]), place(corner[2])};
  Vector normal = cross(p[1] - p[0], p[2] - p[0]);
  for (int k = 0; k < 3; ++k) out.lens[k] = lens(corner[kEndsOf[k][0]], corner[kEndsOf[k][1]]);
  double size = norm(normal);
  if (!(size > kThin * out.lens[2].length * out.lens[1].length)) {
    size = norm(normal_accurate(p[0], p[1], p[2]));
  }
  out.area = 0.5 * size;
  double away[3];  // of the centre from each edge
  int least = 0;
  for (int k = 0; k < 3; ++k) {
    const int a = kEndsOf[k][0], b = kEndsOf[k][1];
    const Lens& side = out.lens[k];
    const Vector u = p[k] - p[a], v = p[k] - p[b], w = p[b] - p[a];
    double top = dot(u, v);
    if (weighted()) {
      // Each share from its own end: the third corner may almost coincide with one of them.
      const double wk = weight(corner[k]), length_sq = dot(w, w);
      top += (-dot(v, w) * (weight(corner[a]) - wk) + dot(u, w) * (weight(corner[b]) - wk)) /
             length_sq;
    }
    away[k] = 0.5 * side.length * (top / size);
    if (side.circle < out.lens[least].circle) least = k;
  }
  const double smallest = out.lens[least].circle;
  const double cosine =
      smallest > 0.0 ? std::max(-1.0, std::min(1.0, away[least] / smallest)) : 1.0;
  const double sine = std::sqrt((1.0 - std::fabs(cosine)) * (1.0 + std::fabs(cosine)));
  out.height = smallest * sine;
  double c[3], s[3];  // cosines and sines of the half angles, but for a factor
  for (int k = 0; k < 3; ++k) {
    const double circle = out.lens[k].circle;
    c[k] = k == least || circle == 0.0 ? (k == least ? cosine : 1.0) : away[k] / circle;
    s[k] = k == least || circle == 0.0 ? (k == least ? sine : 0.0) : out.height / circle;
    out.half[k] = std::atan2(s[k], c[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const int a = kEndsOf[k][0], b = kEndsOf[k][1];  // corners; as edges, those at corner k
    const int e = out.lens[a].circle <= out.lens[b].circle ? a : b;
    const Lens& side = out.lens[e];
    // Along edge e from corner k on: where the third corner is, how high it is above.
    const int other = e == a ? b : a;
    const double x = dot(p[e] - p[k], p[other] - p[k]) / side.length, y = size / side.length;
    const double h = side.from[kEndsOf[e][0] == k ? 0 : 1];
    out.turn[k] = std::atan2(radius(corner[k]) * y * s[e], side.circle * x - h * y * c[e]);
    const double ha = out.lens[b].from[kEndsOf[b][0] == k ? 0 : 1];  // towards corner a
    const double hb = out.lens[a].from[kEndsOf[a][0] == k ? 0 : 1];
    out.share[k] = 0.5 * (ha * away[b] + hb * away[a]);
  }
  return out;
}

// What each corner has of a tetrahedron: pyramids from the corner over the kites between it,
// its edges' and the faces' centres, as high as the tetrahedron's centre. Of slivers the
// centre is known poorly along their normal; that is small as long as all faces see the same
// centre, found from the largest face, and none beyond the point where its spheres meet.
void Balls3::share_cell(const Id* corner, const Vector* normal, double det, double* share) const {
  int best = 0;
  double size_sq[4];
  for (int k = 0; k < 4; ++k) {
    size_sq[k] = dot(normal[k], normal[k]);
    if (size_sq[k] > size_sq[best]) best = k;
  }
  const Place3 p[4] = {place(corner[0]), place(corner[1]), place(corner[2]), place(corner[3])};
  double reach[4][4];  // g[i][j]: from i, how far the radical plane is along j - i, times length
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const Vector u = p[j] - p[i];
      const double half = 0.5 * dot(u, u);
      const double lean = 0.5 * (weight(corner[i]) - weight(corner[j]));
      reach[i][j] = half + lean;
      reach[j][i] = half - lean;
    }
  }
  // Seen from the corner nearest to the one across: the two may almost coincide.
  int turn = 0;
  double nearest = HUGE_VAL;
  for (int m = 0; m < 3; ++m) {
    const Vector u = p[best] - p[kFaceOf[best][m]];
    if (dot(u, u) >= nearest) continue;
    nearest = dot(u, u);
    turn = m;
  }
  const int a = kFaceOf[best][turn], b = kFaceOf[best][(turn + 1) % 3],
            c = kFaceOf[best][(turn + 2) % 3];
  const Vector u = p[b] - p[a], v = p[c] - p[a], q = p[best] - p[a];
  const Vector n = normal[best];
  const Vector turned = cross(u, v);
  const double side = dot(turned, n) < 0.0 ? -1.0 : 1.0;
  const Vector vn = cross(v, n), nu = cross(n, u);
  const double x = side * reach[a][b] / size_sq[best], y = side * reach[a][c] / size_sq[best];
  const Vector foot{x * vn.x + y * nu.x, x * vn.y + y * nu.y, x * vn.z + y * nu.z};
  const double most = std::sqrt(std::max(0.0, square(corner[a]) - dot(foot, foot)) / size_sq[best]);
  double rise = (reach[a][best] - dot(foot, q)) / det;  // over the length of the normal
  rise = std::max(-most, std::min(most, rise));
  const Vector centre{foot.x + rise * n.x, foot.y + rise * n.y, foot.z + rise * n.z};
  for (int f = 0; f < 4; ++f) {
    const int first = kFaceOf[f][0];
    const Vector shift = p[first] - p[a];
    const Vector here{centre.x - shift.x, centre.y - shift.y, centre.z - shift.z};
    const double height = dot(here, normal[f]) / size_sq[f];
    for (int m = 0; m < 3; ++m) {
      const int i = kFaceOf[f][m], j = kFaceOf[f][kEndsOf[m][0]], k = kFaceOf[f][kEndsOf[m][1]];
      const Vector ij = p[j] - p[i], ik = p[k] - p[i], jk = p[k] - p[j];
      // The distance of the face's centre from each edge, times the normal over the edge.
      double off_ij = 0.5 * dot(ik, jk), off_ik = -0.5 * dot(ij, jk);
      if (weighted()) {
        const double wi = weight(corner[i]), wj = weight(corner[j]), wk = weight(corner[k]);
        const double at_i = dot(ij, ik), at_j = -dot(ij, jk), at_k = dot(ik, jk);
        off_ij += 0.5 * (at_j * (wi - wk) + at_i * (wj - wk)) / dot(ij, ij);
        off_ik += 0.5 * (at_k * (wi - wj) + at_i * (wk - wj)) / dot(ik, ik);
      }
      share[i] += height * (reach[i][j] * off_ij + reach[i][k] * off_ik) / 6.0;
    }
  }
}

}  // namespace alphamesh
