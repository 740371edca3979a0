// What every file of bindings shares: arrays in and out, and work that can be watched.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "memory.hpp"
#include "parallel.hpp"
#include "predicates2.hpp"
#include "rings2.hpp"

namespace alphamesh {

namespace nb = nanobind;

struct TooManyPoints : std::length_error {
  using std::length_error::length_error;
};

using Points2 = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
template <std::size_t K>
using Tuples2 = nb::ndarray<const double, nb::shape<-1, K, 2>, nb::c_contig, nb::device::cpu>;

// Hands a buffer over to NumPy without a copy.
template <class T>
nb::object array(Buffer<T>&& buffer, std::size_t columns = 1) {
  auto* owner = new Buffer<T>(std::move(buffer));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<Buffer<T>*>(p); });
  const std::size_t shape[2] = {owner->size() / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, T>(owner->data(), columns == 1 ? 1 : 2, shape, capsule));
}

// Below this the work is over before anybody could interrupt it.
constexpr std::size_t kWatched = 50000;

// Runs work() without the GIL; on large clouds in a thread of its own, while this one
// looks after signals (Ctrl-C) and the progress callback.
template <class Work>
void run_watched(Job& job, std::size_t size, const nb::object& progress, Work&& work) {
  const Recycling recycling;
  if (size < kWatched) {
    const nb::gil_scoped_release released;
    work();
    return;
  }
  std::mutex lock;
  std::condition_variable finished;
  bool done = false;
  std::exception_ptr error;
  auto watched = [&] {
    prepare_to_throw();
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard<std::mutex> guard(lock);
    done = true;
    finished.notify_one();
  };
  std::thread worker;
  try {
    worker = std::thread(watched);
  } catch (const std::system_error&) {  // no room for another thread: unwatched, then
    const nb::gil_scoped_release released;
    work();
    return;
  }
  bool stop = false;
  for (;;) {
    {
      const nb::gil_scoped_release released;
      std::unique_lock<std::mutex> guard(lock);
      if (stop)
        finished.wait(guard, [&] { return done; });
      else
        finished.wait_for(guard, std::chrono::milliseconds(50), [&] { return done; });
      if (done) break;
    }
    bool failed = PyErr_CheckSignals() != 0;
    if (!failed && !progress.is_none()) {
      PyObject* result = PyObject_CallFunction(progress.ptr(), "d", job.progress());
      Py_XDECREF(result);
      failed = result == nullptr;
    }
    if (failed) {
      stop = true;  // the Python error stays set; nothing below calls Python before it is raised
      job.cancel();
      const nb::gil_scoped_release released;
      worker.join();
      break;
    }
  }
  if (worker.joinable()) {
    const nb::gil_scoped_release released;
    worker.join();
  }
  if (stop) throw nb::python_error();
  if (error) std::rethrow_exception(error);
  if (!progress.is_none()) progress(1.0);
}

// Small clouds are done before a second thread has started.
inline int useful_threads(int threads, std::size_t n) { return n < 10000 ? 1 : threads; }

using Ids = nb::ndarray<const std::int32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Values = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Flags = nb::ndarray<const bool, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Values of points: an empty array where all are born at once.
inline const double* births_or_null(const Values& births) {
  return births.shape(0) == 0 ? nullptr : births.data();
}

inline ComplexView2 view_of(const Points2& points, const Ids& triangles, const Ids& edges,
                            const Ids& edge_triangles) {
  return {points.data(), points.shape(0), triangles.data(),     triangles.shape(0),
          edges.data(),  edges.shape(0),  edge_triangles.data()};
}

// Weights of points: an empty array for balls of equal size.
inline ComplexView2 weighted_view(ComplexView2 view, const Values& weights) {
  if (weights.shape(0) != 0) view.weights = weights.data();
  return view;
}

inline nb::object points_array(Buffer<Point2>&& buffer) {
  auto* owner = new Buffer<Point2>(std::move(buffer));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<Buffer<Point2>*>(p); });
  static_assert(sizeof(Point2) == 2 * sizeof(double));
  const std::size_t shape[2] = {owner->size(), 2};
  return nb::cast(
      nb::ndarray<nb::numpy, double>(reinterpret_cast<double*>(owner->data()), 2, shape, capsule));
}

// Each file of bindings adds its functions to the module.
void bind_incidence3(nb::module_& m);
void bind_outlines2(nb::module_& m);
void bind_periodic(nb::module_& m);
void bind_persistence3(nb::module_& m);
void bind_regular2(nb::module_& m);
void bind_regular3(nb::module_& m);
void bind_space3(nb::module_& m);
void bind_surface3(nb::module_& m);
void bind_tiles(nb::module_& m);
void bind_unions(nb::module_& m);
void bind_voronoi2(nb::module_& m);

}  // namespace alphamesh
