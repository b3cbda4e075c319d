// SPDX-License-Identifier: BSD-3-Clause
#include "formats/text_mesh.hpp"

#include "io/text_rows.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace trime::formats {
namespace {

TEST(TextNumbers, AreThoseOfPrintfAndReadBackTheSame) {
  for (const double number : {0.1, 1.0, -2.5e-300, 1.0 / 3, 123456789.123456789, 0.0, -0.0, 5e-324, 1e22}) {
    std::string text;
    io::append_number(text, number);
    char expected[40];
    std::snprintf(expected, sizeof expected, "%.17g", number);
    EXPECT_EQ(text, expected);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), number);
  }
}

TEST(TextMesh, KnowsItsFiles) {
  for (const char* file : {"a.b_final_xy_id.txt", "a.b_12_tria_bar_ids.txt", "a.b_1_tria_quality_stat_er.txt",
                           "a.b_final_bdry_vertices_ids_CCW_0.txt", "a.b_7_bdry_vertices_coords_CCW_13.txt",
                           "a.b_tria_quality_stat_overall.txt", "fixed_pt_id.txt", "fixed_pt_coords.txt"})
    EXPECT_TRUE(is_text_mesh_file(file, "a.b")) << file;
  for (const char* file : {"notes.txt", "a.b.txt", "a.b_final.txt", "a.b_last_xy_id.txt", "a.b__xy_id.txt", "a.b_1.txt",
                           "a.b_1_xy_id.dat", "b_1_xy_id.txt", "a.b_1_bdry_vertices_ids_CCW_.txt",
                           "a.b_1_bdry_vertices_ids_CCW_x.txt", "a.b_1_tria_quality_stat_overall.txt", ""})
    EXPECT_FALSE(is_text_mesh_file(file, "a.b")) << file;
}

TEST(TextMesh, TheOverallQualityHasThirteenColumns) {
  mesh::QualitySummary quality;
  quality.alpha = {1, 2, 3, 4, 5}; // median, mean, max, half-mean, standard deviation
  quality.beta = {6, 7, 8, 9, 10};
  const std::vector<TextQuality> meshes{{1, 100, 200, quality}, {12, 300, 400, quality}};
  EXPECT_EQ(overall_quality_text(meshes), "1 100 200 3 8 1 6 2 7 4 9 5 10 \n12 300 400 3 8 1 6 2 7 4 9 5 10 \n");
}

} // namespace
} // namespace trime::formats
