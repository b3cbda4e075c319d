// SPDX-License-Identifier: BSD-3-Clause
// What is kept comes back bit for bit; what is missing or of another type is an error.
#include "core/state_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime {
namespace {

enum class Colour { red, blue };

struct Members {
  int count = 0;
  bool is_on = false;
  Colour colour = Colour::red;
  double number = 0;
  FixedSum sum;

  void visit(StateFields& fields) {
    fields.field("count", count);
    fields.field("is_on", is_on);
    fields.field("colour", colour);
    fields.field("number", number);
    fields.field("sum", sum);
  }
};

TEST(StateFields, WhatIsKeptComesBack) {
  Members kept{-3, true, Colour::blue, std::sqrt(2.0) * 1e-300, {}};
  for (int k = 0; k < 100000; ++k)
    kept.sum.add(-123456.789);
  StateNumbers numbers;
  StateFields keeping = StateFields::keeping(numbers);
  kept.visit(keeping);
  Members back;
  StateFields restoring = StateFields::restoring(numbers);
  back.visit(restoring);
  EXPECT_EQ(back.count, -3);
  EXPECT_TRUE(back.is_on);
  EXPECT_EQ(back.colour, Colour::blue);
  EXPECT_EQ(back.number, kept.number);
  EXPECT_EQ(back.sum.value(), kept.sum.value());
}

TEST(StateFields, WhatIsMissingOrOfAnotherTypeIsAnError) {
  const StateNumbers numbers{{"count", 1.0}};
  StateFields restoring = StateFields::restoring(numbers);
  int count = 0;
  double number = 0;
  EXPECT_THROW(restoring.field("count", count), FileError);
  EXPECT_THROW(restoring.field("number", number), FileError);
  EXPECT_NO_THROW(restoring.field("count", number));
}

} // namespace
} // namespace trime
