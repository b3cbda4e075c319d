// SPDX-License-Identifier: BSD-3-Clause
// The text of a config. What is understood is written in full, and that must be understood as the same.
#include "app/config.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::survives([&] {
    const app::RunOptions options = app::parse_config(fuzz::text_of(data, size), "case.ini", {});
    try {
      const app::RunOptions again = app::parse_config(options.resolved, "case.ini", {});
      TRIME_ASSERT(again.resolved == options.resolved, "{}\nbecomes\n{}", options.resolved, again.resolved);
    } catch (const Error& error) {
      TRIME_ASSERT(false, "{}\n{}", error.what(), options.resolved);
    }
  });
  return 0;
}
