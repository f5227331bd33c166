// The counter that other tests rely on: what it does not see, they do not see.
#include "allocations.h"

#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "count_allocations.h"

namespace panache {
namespace {

struct alignas(64) Aligned {
  char bytes[64];
};
void* volatile escaped;  // So that no allocation is left out.

// How many allocations it takes to make a T, or three, and give them back.
template <class T>
long counted(bool array, bool nothrow) {
  const long before = test::allocations;
  T* made = nullptr;
  if (array) {
    made = nothrow ? new (std::nothrow) T[3] : new T[3];
  } else {
    made = nothrow ? new (std::nothrow) T : new T;
  }
  escaped = made;
  EXPECT_EQ(reinterpret_cast<size_t>(made) % alignof(T), 0u);
  array ? delete[] made : delete made;
  return test::allocations - before;
}

TEST(Allocations, every_form_of_new_is_counted) {
  for (const bool array : {false, true}) {
    for (const bool nothrow : {false, true}) {
      EXPECT_EQ(counted<int>(array, nothrow), 1) << array << nothrow;
      EXPECT_EQ(counted<Aligned>(array, nothrow), 1) << array << nothrow;
    }
  }
}

TEST(Allocations, every_form_of_new_fails_when_it_is_told_to) {
  test::allocations_left = 0;
  bool threw = false;
  try {
    escaped = new Aligned;
  } catch (const std::bad_alloc&) {
    threw = true;
  }
  escaped = new (std::nothrow) Aligned;
  test::allocations_left = LONG_MAX;
  EXPECT_TRUE(threw);
  EXPECT_EQ(escaped, nullptr);
}

}  // namespace
}  // namespace panache
