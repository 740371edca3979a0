#include "quotient.hpp"

#include <algorithm>
#include <stdexcept>

namespace alphamesh {
namespace {

using Id = std::int32_t;

constexpr int kRowBits = 26, kCodeBits = 5;

// A simplex of K + 1 vertices in a bucket of those that share the first row: the other rows,
// then their offsets, as numbers; then where it came from.
template <int K>
struct Key;

template <>
struct Key<3> {
  std::uint64_t rows, more;  // second and third row; fourth row and offsets
  std::uint32_t source;

  Key() = default;
  Key(const std::uint64_t* row, const std::uint64_t* code, std::uint32_t from)
      : rows(row[1] << 32 | row[2]),
        more(row[3] << 32 | code[1] << 2 * kCodeBits | code[2] << kCodeBits | code[3]),
        source(from) {}
  bool same(const Key& o) const { return rows == o.rows && more == o.more; }
  bool operator<(const Key& o) const {
    if (rows != o.rows) return rows < o.rows;
    return more != o.more ? more < o.more : source < o.source;
  }
  void read(std::uint64_t* row, std::uint64_t* code) const {
    row[1] = rows >> 32, row[2] = rows & 0xffffffffu, row[3] = more >> 32;
    code[1] = more >> 2 * kCodeBits & 31, code[2] = more >> kCodeBits & 31, code[3] = more & 31;
  }
};

template <>
struct Key<2> {
  std::uint64_t word;
  std::uint32_t source;

  Key() = default;
  Key(const std::uint64_t* row, const std::uint64_t* code, std::uint32_t from)
      : word((row[1] << kRowBits | row[2]) << 2 * kCodeBits | code[1] << kCodeBits | code[2]),
        source(from) {}
  bool same(const Key& o) const { return word == o.word; }
  bool operator<(const Key& o) const { return word != o.word ? word < o.word : source < o.source; }
  void read(std::uint64_t* row, std::uint64_t* code) const {
    row[1] = word >> (kRowBits + 2 * kCodeBits);
    row[2] = word >> 2 * kCodeBits & ((1u << kRowBits) - 1);
    code[1] = word >> kCodeBits & 31, code[2] = word & 31;
  }
};

template <>
struct Key<1> {
  std::uint32_t word, source;

  Key() = default;
  Key(const std::uint64_t* row, const std::uint64_t* code, std::uint32_t from)
      : word(static_cast<std::uint32_t>(row[1] << kCodeBits | code[1])), source(from) {}
  bool same(const Key& o) const { return word == o.word; }
  bool operator<(const Key& o) const { return word != o.word ? word < o.word : source < o.source; }
  void read(std::uint64_t* row, std::uint64_t* code) const {
    row[1] = word >> kCodeBits, code[1] = word & 31;
  }
};

template <>
struct Key<0> {
  std::uint32_t source;

  Key() = default;
  Key(const std::uint64_t*, const std::uint64_t*, std::uint32_t from) : source(from) {}
  bool same(const Key&) const { return true; }
  bool operator<(const Key& o) const { return source < o.source; }
  void read(std::uint64_t*, std::uint64_t*) const {}
};

// Three offsets in -1 ... 1 as one number, in lexicographic order.
std::uint64_t code_of(const int* offset) {
  std::uint64_t code = 0;
  for (int k = 0; k < 3; ++k) {
    if (offset[k] < -1 || offset[k] > 1) throw std::logic_error("a simplex longer than a box");
    code = 3 * code + static_cast<std::uint64_t>(offset[k] + 1);
  }
  return code;
}

void decode(std::uint64_t code, std::int8_t* offset) {
  for (int k = 2; k >= 0; --k) {
    offset[k] = static_cast<std::int8_t>(static_cast<int>(code % 3) - 1);
    code /= 3;
  }
}

struct Vertex {
  Id row;
  int offset[3];
  std::int32_t copy;

  bool operator<(const Vertex& o) const {
    if (row != o.row) return row < o.row;
    return std::lexicographical_compare(offset, offset + 3, o.offset, o.offset + 3);
  }
};

// Of vertices in order, but the one at `skipped`; offsets become relative to the first.
template <int K>
Key<K> key_of(const Vertex* v, int skipped, std::uint32_t source) {
  std::uint64_t row[4] = {0, 0, 0, 0}, code[4] = {0, 0, 0, 0};
  const Vertex& first = v[skipped == 0 ? 1 : 0];
  for (int i = 1; i <= K; ++i) {
    const Vertex& w = v[skipped <= i ? i + 1 : i];
    int relative[3];
    for (int k = 0; k < 3; ++k) relative[k] = w.offset[k] - first.offset[k];
    row[i] = static_cast<std::uint32_t>(w.row);
    code[i] = code_of(relative);
  }
  return {row, code, source};
}

// Simplices of K + 1 vertices, in buckets by first row.
template <int K>
class Buckets {
 public:
  explicit Buckets(std::size_t rows) : start_(rows + 1) {
    std::fill(start_.begin(), start_.end(), 0);
  }
  void count(Id row) { ++start_[static_cast<std::size_t>(row) + 1]; }
  void allot() {
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    key_ = Buffer<Key<K>>(start_[start_.size() - 1]);
    next_ = Buffer<std::size_t>(start_.size() - 1);
    std::copy(start_.data(), start_.data() + next_.size(), next_.begin());
  }
  void put(Id row, const Key<K>& key) { key_[next_[static_cast<std::size_t>(row)]++] = key; }
  std::size_t size() const { return key_.size(); }

  // The simplices, each once; number_of[source] is that of each key.
  Layer number(Job& job, Buffer<Id>& number_of);

 private:
  Buffer<std::size_t> start_, next_;
  Buffer<Key<K>> key_;
};

template <int K>
void write_simplex(Layer& layer, std::size_t i, std::size_t first, const Key<K>& key) {
  std::uint64_t row[4] = {first}, code[4] = {13};
  key.read(row, code);
  for (std::size_t v = 0; v <= K; ++v) {
    const std::size_t at = i * (K + 1) + v;
    layer.row[at] = static_cast<Id>(row[v]);
    decode(code[v], &layer.offset[3 * at]);
  }
}

template <int K>
Layer Buckets<K>::number(Job& job, Buffer<Id>& number_of) {
  const std::size_t rows = next_.size();
  const Parts parts(rows, job, 1024);
  std::vector<std::size_t> first(parts.count() + 1, 0);
  job.run(parts.count(), [&](std::size_t part) {
    std::size_t distinct = 0;
    for (std::size_t r = parts.begin(part); r < parts.end(part); ++r) {
      Key<K>*from = key_.data() + start_[r], *to = key_.data() + start_[r + 1];
      std::sort(from, to);
      for (Key<K>* k = from; k < to; ++k) distinct += k == from || !k->same(k[-1]) ? 1 : 0;
    }
    first[part + 1] = distinct;
  });
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  Layer layer;
  layer.count = first.back();
  layer.row = Buffer<Id>((K + 1) * layer.count);
  layer.offset = Buffer<std::int8_t>(3 * (K + 1) * layer.count);
  job.run(parts.count(), [&](std::size_t part) {
    std::size_t next = first[part];
    for (std::size_t r = parts.begin(part); r < parts.end(part); ++r) {
      for (std::size_t k = start_[r]; k < start_[r + 1]; ++k) {
        if (k == start_[r] || !key_[k].same(key_[k - 1])) {
          write_simplex<K>(layer, next++, r, key_[k]);
        }
        number_of[key_[k].source] = static_cast<Id>(next - 1);
      }
    }
  });
  return layer;
}

template <int K>
void vertices_of(const Layer& layer, std::size_t i, Vertex* v) {
  for (int j = 0; j <= K; ++j) {
    const std::size_t at = i * (K + 1) + static_cast<std::size_t>(j);
    v[j].row = layer.row[at];
    for (int k = 0; k < 3; ++k) v[j].offset[k] = layer.offset[3 * at + static_cast<std::size_t>(k)];
  }
}

// The faces of a layer of dimension K, and which of them each simplex has.
template <int K>
Layer faces_of(Layer& layer, std::size_t rows, Job& job) {
  const std::size_t sources = (K + 1) * layer.count;
  if (sources > 0xffffffffu) throw std::length_error("too many simplices");
  Buckets<K - 1> buckets(rows);
  for (std::size_t i = 0; i < layer.count; ++i) {
    for (int j = 0; j <= K; ++j) buckets.count(layer.row[i * (K + 1) + (j == 0 ? 1 : 0)]);
  }
  buckets.allot();
  Vertex v[K + 1];
  for (std::size_t i = 0; i < layer.count; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    vertices_of<K>(layer, i, v);
    for (int j = 0; j <= K; ++j) {
      const auto source = static_cast<std::uint32_t>(i * (K + 1) + static_cast<std::size_t>(j));
      buckets.put(v[j == 0 ? 1 : 0].row, key_of<K - 1>(v, j, source));
    }
  }
  layer.face = Buffer<Id>(sources);
  return buckets.number(job, layer.face);
}

// Cells whose first vertex lies in the box.
template <int D>
Layer canonical_cells(const Copies& copies, const Id* cells, std::size_t count, Job& job) {
  Buffer<Key<D>> key(count);
  Buffer<Id> row(count);  // the first; -1 of cells that lie elsewhere
  const Parts parts(count, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t c = parts.begin(part); c < parts.end(part); ++c) {
      Vertex v[D + 1];
      for (std::size_t j = 0; j <= D; ++j) {
        v[j].copy = cells[(D + 1) * c + j];
        const auto copy = static_cast<std::size_t>(v[j].copy);
        v[j].row = copies.row[copy];
        for (std::size_t k = 0; k < 3; ++k) v[j].offset[k] = copies.offset[3 * copy + k];
      }
      std::sort(v, v + D + 1);
      row[c] = static_cast<std::size_t>(v[0].copy) < copies.base ? v[0].row : -1;
      if (row[c] >= 0) key[c] = key_of<D>(v, D + 1, 0);
    }
  });
  Buckets<D> buckets(copies.rows);
  for (std::size_t c = 0; c < count; ++c) {
    if (row[c] >= 0) buckets.count(row[c]);
  }
  buckets.allot();
  std::uint32_t found = 0;
  for (std::size_t c = 0; c < count; ++c) {
    if (row[c] < 0) continue;
    key[c].source = found++;
    buckets.put(row[c], key[c]);
  }
  Buffer<Id> number(found);
  Layer layer = buckets.number(job, number);
  if (layer.count != found) throw std::logic_error("a cell was met twice");
  return layer;
}

}  // namespace

template <int D>
std::vector<Layer> quotient(const Copies& copies, const Id* cells, std::size_t count, Job& job) {
  if (copies.rows > std::size_t{1} << kRowBits) throw std::length_error("too many points");
  std::vector<Layer> layers(D + 1);
  layers[D] = canonical_cells<D>(copies, cells, count, job);
  job.advance(0.1);
  if constexpr (D == 3) layers[2] = faces_of<3>(layers[3], copies.rows, job);
  job.advance(0.1);
  if constexpr (D >= 2) layers[1] = faces_of<2>(layers[2], copies.rows, job);
  layers[0] = faces_of<1>(layers[1], copies.rows, job);
  return layers;
}

template std::vector<Layer> quotient<1>(const Copies&, const Id*, std::size_t, Job&);
template std::vector<Layer> quotient<2>(const Copies&, const Id*, std::size_t, Job&);
template std::vector<Layer> quotient<3>(const Copies&, const Id*, std::size_t, Job&);

Buffer<Id> cofaces(const Layer& cells, std::size_t columns, std::size_t facets) {
  Buffer<Id> out(2 * facets);
  std::fill(out.begin(), out.end(), -1);
  for (std::size_t i = 0; i < columns * cells.count; ++i) {
    Id* pair = &out[2 * static_cast<std::size_t>(cells.face[i])];
    if (pair[1] >= 0) throw std::logic_error("a facet of three cells");
    pair[pair[0] < 0 ? 0 : 1] = static_cast<Id>(i / columns);
  }
  return out;
}

}  // namespace alphamesh
