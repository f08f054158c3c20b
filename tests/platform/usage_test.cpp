#include "platform/usage.h"

#include <gtest/gtest.h>

namespace unsnarl::platform {
namespace {

TEST(Usage, memory) {
  EXPECT_GT(resident_memory_mb(), 1);
  EXPECT_GE(peak_memory_mb(), 0.5 * resident_memory_mb());
}

TEST(Usage, time_grows_with_work) {
  const double before = cpu_seconds();
  volatile double sum = 0;
  while (cpu_seconds() < before + 0.01) sum = sum + 1;
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace unsnarl::platform
