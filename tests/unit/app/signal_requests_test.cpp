// SPDX-License-Identifier: BSD-3-Clause
#include "app/signal_requests.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

TEST(SignalRequests, AreForgotten) {
  SignalRequests signals;
  signals.ask_to_stop();
  signals.forget_stopping();
  EXPECT_FALSE(signals.asks_to_stop());
  EXPECT_FALSE(signals.asks_to_end());
}

TEST(SignalRequests, AnEndIsNotForgotten) {
  SignalRequests signals;
  signals.ask_to_stop();
  signals.ask_to_end(); // while the ranks agree that the first one cannot be followed
  signals.forget_stopping();
  EXPECT_TRUE(signals.asks_to_stop());
  EXPECT_TRUE(signals.asks_to_end());
}

} // namespace
} // namespace trime::app
