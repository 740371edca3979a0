// The smallest orthosphere of up to four sites, in any arithmetic.
#pragma once

namespace alphamesh {

// The orthosphere of up to four sites a, a + arm[0] ..., by the Gram matrix of the arms:
// centre a + sum of part[i] arm[i - 1] / (2 determinant).
template <int K, class R>
struct Orthosphere {
  R gram[K][K], lift[K];       // squared arms less the weights of their ends, plus that of a
  R determinant, part[K + 1];  // barycentric coordinates times 2 determinant

  Orthosphere(const R (*arm)[3], const R* change);
};

// K = 1, 2, 3; `change` is the weight of a less that of each other vertex.
template <int K, class R>
Orthosphere<K, R>::Orthosphere(const R (*arm)[3], const R* change) {
  for (int i = 0; i < K; ++i) {
    for (int j = 0; j <= i; ++j) {
      gram[i][j] = arm[i][0] * arm[j][0] + arm[i][1] * arm[j][1] + arm[i][2] * arm[j][2];
      gram[j][i] = gram[i][j];
    }
    lift[i] = gram[i][i] + change[i];
  }
  if constexpr (K == 1) {
    determinant = gram[0][0];
    part[1] = lift[0];
    part[0] = determinant + determinant - part[1];
  } else if constexpr (K == 2) {
    determinant = gram[0][0] * gram[1][1] - gram[0][1] * gram[0][1];
    part[1] = lift[0] * gram[1][1] - lift[1] * gram[0][1];
    part[2] = lift[1] * gram[0][0] - lift[0] * gram[0][1];
    part[0] = determinant + determinant - (part[1] + part[2]);
  } else {
    R minor[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        minor[i][j] = gram[a][c] * gram[b][d] - gram[a][d] * gram[b][c];
        minor[j][i] = minor[i][j];
      }
    }
    determinant = gram[0][0] * minor[0][0] + gram[0][1] * minor[0][1] + gram[0][2] * minor[0][2];
    for (int i = 0; i < 3; ++i) {
      part[i + 1] = lift[0] * minor[i][0] + lift[1] * minor[i][1] + lift[2] * minor[i][2];
    }
    part[0] = determinant + determinant - (part[1] + part[2] + part[3]);
  }
}

}  // namespace alphamesh
