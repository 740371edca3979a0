#include <cstdio>

#include "selftest.hpp"

int main() {
  const std::string fault = alphamesh::self_test();
  if (!fault.empty()) std::fprintf(stderr, "alphamesh self-test: %s\n", fault.c_str());
  return fault.empty() ? 0 : 1;
}
