// SPDX-License-Identifier: BSD-3-Clause
// The warning of chords that are far shorter than the edges asked for: how many of how many, the worst and its place.
#include "fitting/size_warnings.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace trime::fitting {
namespace {

using geometry::Vec2;

constexpr int per_side = 64;

/// A square with equal chords of a 64th of its side, and short ones that begin in the middle of its lower side.
sites::Stage stage_with(const std::vector<double>& short_chords) {
  std::vector<Vec2> places;
  constexpr double step = 0.8 / per_side;
  for (const auto& [from, along] :
       {std::pair{Vec2{0.1, 0.1}, Vec2{step, 0}}, std::pair{Vec2{0.9, 0.1}, Vec2{0, step}},
        std::pair{Vec2{0.9, 0.9}, Vec2{-step, 0}}, std::pair{Vec2{0.1, 0.9}, Vec2{0, -step}}})
    for (int k = 0; k < per_side; ++k) {
      places.push_back(from + static_cast<double>(k) * along);
      if (places.size() == per_side / 2 + 1)
        for (const double chord : short_chords)
          places.push_back(places.back() + Vec2{chord, 0});
    }
  sites::Stage stage;
  stage.size = std::make_unique<sizing::UniformSize>(step);
  const auto n = static_cast<LocalIndex>(places.size());
  for (LocalIndex k = 0; k < n; ++k)
    stage.polygon.sites.push_back({places[at(k)], (k + n - 1) % n, (k + 1) % n, 1, false});
  stage.polygon.loop_start = {0, n};
  return stage;
}

std::string warned(const sites::Stage& stage, bool has_least_size) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  {
    Log log(LogLevel::warning, true, file.get());
    warn_of_fine_features(stage, has_least_size, log);
  }
  std::fflush(file.get());
  std::rewind(file.get());
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  return text;
}

TEST(SizeWarnings, ShortChordsAreToldWithTheirNumberAndTheWorstPlace) {
  const std::string text = warned(stage_with({0.001, 0.0005, 0.00075}), false);
  EXPECT_NE(text.find("3 of 259 boundary edges are far shorter"), std::string::npos) << text;
  EXPECT_NE(text.find("the worst edge is 0.0005 long where the size is 0.0125, at (0.50125, 0.1)"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("min_size"), std::string::npos) << text;
}

TEST(SizeWarnings, ChordsThatAreNotFarShorterAreNotTold) {
  EXPECT_EQ(warned(stage_with({}), false), "");
  EXPECT_EQ(warned(stage_with({0.0013, 0.002}), false), "");
}

TEST(SizeWarnings, WithALeastSizeAFewShortChordsAreNotTold) {
  EXPECT_EQ(warned(stage_with({0.001, 0.001}), true), ""); // 2 of 258
  const std::string text = warned(stage_with({0.001, 0.001, 0.001}), true);
  EXPECT_NE(text.find("3 of 259 boundary edges"), std::string::npos) << text;
  EXPECT_NE(text.find("a smaller min_size would help"), std::string::npos) << text;
}

} // namespace
} // namespace trime::fitting
