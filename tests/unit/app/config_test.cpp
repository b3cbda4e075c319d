// SPDX-License-Identifier: BSD-3-Clause
// The option table and the config: every key, every bad value, all mistakes at once, and the printed config as input.
#include "app/config.hpp"

#include "app/option_table.hpp"
#include "app/option_value.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::app {
namespace {

const std::string good = "[shape]\ngeometry = difference(box, hole)\n"                                         // 1, 2
                         "[shape.box]\ntype = rectangle\nx_min = 0.1\nx_max = 0.9\ny_min = 0.1\ny_max = 0.9\n" // 3-8
                         "[shape.hole]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.1\n"                       // 9-12
                         "[meshing]\nmethod = distmesh\npoints = 5000\n";                                      // 13-15

std::string errors_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_config(text, "dir/c.ini", overrides);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

/// The good config with one override must fail with a message that holds `expected`.
void expect_refused(const std::string& override_text, const std::string& expected) {
  const std::string message = errors_of(good, {override_text});
  EXPECT_NE(message.find(expected), std::string::npos) << override_text << " gave: " << message;
  EXPECT_NE(message.find("command line: "), std::string::npos) << message;
}

TEST(Config, ExpressionShape) {
  const std::string text = "[shape]\ngeometry = f\n[shape.f]\ntype = expression\nsdf = x^2 + y^2 - 0.25\n"
                           "[meshing]\nmethod = distmesh\npoints = 5000\n";
  const RunOptions options = parse_config(text, "c.ini", {});
  EXPECT_EQ(options.parts.at(0).type, "expression");
  EXPECT_EQ(options.parts.at(0).sdf, "x^2 + y^2 - 0.25");
  const std::string wrong = errors_of(text, {"shape.f.sdf=x^2 + z"});
  EXPECT_NE(wrong.find("'sdf' in [shape.f]"), std::string::npos) << wrong;
  const std::string missing =
      errors_of("[shape]\ngeometry = f\n[shape.f]\ntype = expression\n[meshing]\npoints = 50\n");
  EXPECT_NE(missing.find("[shape.f] of type expression needs 'sdf'"), std::string::npos) << missing;
}

TEST(Config, FixedPoints) {
  const std::string text = "[shape]\ngeometry = map\n[shape.map]\ntype = contour\nfile = map.xy\nnormalize = true\n"
                           "[meshing]\nmethod = distmesh\npoints = 5000\nfixed_points = p.xy\n";
  const RunOptions plain = parse_config(text, "dir/c.ini", {});
  EXPECT_EQ(plain.fixed_points.file, "dir/p.xy");
  EXPECT_TRUE(plain.fixed_points.file_is_relative);
  EXPECT_EQ(plain.fixed_points.normalize_with, "");
  EXPECT_EQ(parse_config(text, "dir/c.ini", {"meshing.fixed_points_normalize_with=map"}).fixed_points.normalize_with,
            "map");
  const std::string unknown = errors_of(text, {"meshing.fixed_points_normalize_with=mop"});
  EXPECT_NE(unknown.find("no part has this name; did you mean 'map'?"), std::string::npos) << unknown;
  const std::string unneeded =
      errors_of(text, {"meshing.fixed_points_normalize_with=map", "shape.map.normalize=false"});
  EXPECT_NE(unneeded.find("with 'normalize = true'"), std::string::npos) << unneeded;
}

TEST(OptionTable, IsSound) {
  for (const Option& option : option_table()) {
    EXPECT_GT(std::string(option.meaning).size(), 3u) << option.key;
    EXPECT_EQ(std::string(option.meaning).find('|'), std::string::npos) << "breaks the Markdown table";
    if (*option.fallback) {
      EXPECT_EQ(value_problem(option, option.section, option.fallback), "") << "a default that is refused";
    }
    const auto same = [&](const Option& o) {
      return std::string(o.section) == option.section && std::string(o.key) == option.key &&
             std::string(o.part_type) == option.part_type;
    };
    EXPECT_EQ(std::count_if(option_table().begin(), option_table().end(), same), 1) << option.key;
    EXPECT_NE(help_config().find(option.key), std::string::npos);
  }
}

TEST(OptionValue, TakesAWholeTextOrNothing) {
  EXPECT_EQ(parse_number("1e3"), 1000);
  EXPECT_EQ(parse_number("+.5"), 0.5);
  EXPECT_EQ(parse_number("-0"), 0);
  for (const char* text : {"", "nan", "inf", "-inf", "1,5", "3x", "0x10", "1e999", "+-1", "1 2", "--1"})
    EXPECT_FALSE(parse_number(text)) << text;
  EXPECT_EQ(parse_integer("1e6"), 1000000);
  for (const char* text : {"0.5", "1e17", "ten", ""})
    EXPECT_FALSE(parse_integer(text)) << text;
  EXPECT_EQ(parse_pair("0.5\t-1"), (geometry::Vec2{0.5, -1}));
  for (const char* text : {"1", "1 2 3", "1, 2", "a b"})
    EXPECT_FALSE(parse_pair(text)) << text;
  EXPECT_FALSE(parse_boolean("True"));
}

TEST(Config, UnderstandsAGoodFile) {
  const RunOptions options = parse_config(
      good + "corner_angle = 45\n[parallel]\nmesh_threads = 3\n[shape.map]\ntype = contour\nfile = a/b.xy\n"
             "normalize = true\n[output]\nformats = xdmf\n[log]\nlevel = debug\n",
      "dir/c.ini", {"domain.x_max=2", "shape.hole.radius=0.2"});
  EXPECT_EQ(options.container.max, (geometry::Vec2{2, 1}));
  ASSERT_EQ(options.parts.size(), 3u);
  EXPECT_EQ(options.parts[0].box.min, (geometry::Vec2{0.1, 0.1}));
  EXPECT_EQ(options.parts[1].radius, 0.2);
  EXPECT_EQ(options.parts[2].file, "dir/a/b.xy");
  EXPECT_TRUE(options.parts[2].normalize);
  EXPECT_EQ(options.geometry, "difference(box, hole)");
  EXPECT_EQ(options.mesh.points, 5000);
  EXPECT_FALSE(options.mesh.edge_length.has_value());
  EXPECT_EQ(options.mesh.features.corner_angle, 45);
  EXPECT_EQ(options.mesh_threads, 3);
  EXPECT_EQ(options.setup_threads, 0);
  EXPECT_EQ(options.output.file.name, "c");
  EXPECT_EQ(options.output.file.directory, "out");
  EXPECT_EQ(options.output.formats, std::vector{formats::Format::xdmf});
  EXPECT_EQ(options.log_level, LogLevel::debug);
  ASSERT_EQ(options.warnings.size(), 1u); // map does not occur in the geometry
  EXPECT_NE(options.warnings[0].find("'map'"), std::string::npos);
}

TEST(Config, TakesTheOldNameOfTheGeometryWithAWarning) {
  std::string old = good;
  old.replace(old.find("geometry"), 8, "region");
  const RunOptions options = parse_config(old, "dir/c.ini", {});
  EXPECT_EQ(options.geometry, "difference(box, hole)");
  EXPECT_EQ(options.warnings, (std::vector<std::string>{"dir/c.ini:2: 'region' in [shape] has a new name; write "
                                                        "'geometry = difference(box, hole)' instead"}));
  EXPECT_NE(options.resolved.find("geometry = difference(box, hole)\n"), std::string::npos) << options.resolved;
  EXPECT_EQ(options.resolved.find("region"), std::string::npos) << options.resolved;
  for (const std::string& text : {good, old}) {
    const RunOptions changed = parse_config(text, "c.ini", {"shape.region=box"});
    EXPECT_EQ(changed.geometry, "box");
    EXPECT_NE(changed.warnings.at(text == old ? 1 : 0).find("write 'shape.geometry=...' instead"), std::string::npos);
  }
  EXPECT_EQ(errors_of("[shape]\ngeometry = domain\nregion = domain\n[meshing]\npoints = 50\n"),
            "dir/c.ini:3: 'region' in [shape] is the old name of 'geometry', which is set, too; keep only 'geometry'");
}

TEST(Config, TakesBothWordsForCentroidalVoronoiTessellations) {
  for (const char* word : {"cvt", "cvd"}) {
    const RunOptions options = parse_config(good, "c.ini", {fmt::format("meshing.method={}", word)});
    EXPECT_EQ(options.mesh.method, sweep::Method::cvd);
    EXPECT_TRUE(options.warnings.empty());
    EXPECT_NE(options.resolved.find("method = cvt\n"), std::string::npos) << options.resolved;
  }
  EXPECT_EQ(method_name(sweep::Method::cvd), "cvd"); // the word in mesh files
}

TEST(Config, SaysWhatBecomesOfNarrowParts) {
  const auto features = [](const std::vector<std::string>& overrides) {
    return parse_config(good, "c.ini", overrides).mesh.features;
  };
  EXPECT_EQ(features({}).narrow, boundary::NarrowOutside::keep);
  EXPECT_TRUE(features({}).refine_narrow);
  EXPECT_EQ(features({"meshing.narrow=close"}).narrow, boundary::NarrowOutside::close);
  EXPECT_FALSE(features({"meshing.refine_narrow=false"}).refine_narrow);
  expect_refused("meshing.narrow=closed", "'narrow = closed' in [meshing]");
}

TEST(Config, AbsoluteContourPathsStay) {
  const RunOptions options = parse_config(good + "[shape.map]\ntype = contour\nfile = /data/b.xy\n", "dir/c.ini", {});
  EXPECT_EQ(options.parts[2].file, "/data/b.xy");
  EXPECT_FALSE(options.parts[2].file_is_relative);
}

TEST(Config, QuotesAroundPathsAreDropped) {
  for (const std::string path : {"\"a b#c.xy\"", "'a b#c.xy'", "a b#c.xy"}) {
    const RunOptions options = parse_config(good + "[shape.map]\ntype = contour\nfile = " + path + "\n", "c.ini", {});
    EXPECT_EQ(options.parts[2].file, "a b#c.xy");
    EXPECT_TRUE(options.parts[2].file_is_relative);
  }
}

TEST(Config, ThePrintedConfigReadsBackTheSame) {
  for (const char* change : {"log.interval=0", "meshing.points=1e4", "domain.cells_x=17", "domain.x_max=1.5",
                             "output.name=other", "meshing.seed=7", "output.formats=xdmf"}) {
    const RunOptions first = parse_config(good, "dir/c.ini", {change});
    const RunOptions second = parse_config(first.resolved, "dir/c.ini", {});
    EXPECT_EQ(first.resolved, second.resolved);
    EXPECT_EQ(first.mesh.points, second.mesh.points);
    EXPECT_EQ(first.mesh.cells_x, second.mesh.cells_x);
    EXPECT_EQ(first.output.file.name, second.output.file.name);
    EXPECT_EQ(first.parts.size(), second.parts.size());
  }
  const std::string resolved = parse_config(good, "dir/c.ini", {}).resolved;
  for (const Option& option : option_table())
    EXPECT_TRUE(option.section == part_section || option.section == region_section || option.section == curve_section ||
                option.section == field_section || resolved.find(option.key) != std::string::npos)
        << option.key;
}

TEST(Config, ASectionMayBeMeantByItsBeginning) {
  const std::string told = errors_of("[mesh]\npoints = 5000\n");
  EXPECT_NE(told.find("unknown section [mesh]; did you mean 'meshing'?"), std::string::npos) << told;
}

TEST(Config, TellsAllMistakesAtOnceInTheOrderOfTheFile) {
  EXPECT_EQ(errors_of("[domain]\nx_min = 1\nx_max = 1\n[sizing]\ngradaton = 0.2\n[meshin]\nseed = 1\n[shape]\n"
                      "geometry = hole\n[shape.hole]\ntype = circle\ncenter = 0.5\nradus = 1\n[meshing]\nmethod = ctv\n"
                      "points = 0\n",
                      {"log.levle=info"}),
            "dir/c.ini:3: [domain] needs x_min < x_max, found 1 and 1\n"
            "dir/c.ini:5: unknown key 'gradaton' in [sizing]; did you mean 'gradation'?\n"
            "dir/c.ini:6: unknown section [meshin]; did you mean 'meshing'?\n"
            "dir/c.ini:12: 'center = 0.5' in [shape.hole]: expected two numbers X Y separated by a blank\n"
            "dir/c.ini:13: unknown key 'radus' in [shape.hole]; did you mean 'radius'?\n"
            "dir/c.ini:15: 'method = ctv' in [meshing]: expected one of distmesh, cvt, hybrid; did you mean 'cvt'?\n"
            "dir/c.ini:16: 'points = 0' in [meshing]: expected an integer from 3 to 100000000000\n"
            "command line: unknown key 'levle' in [log]; did you mean 'level'?");
}

TEST(Config, SuggestsTheMeantSectionAndAKeyThatIsNotSet) {
  const std::string said = errors_of("[shape]\ngeometry = domain\n[fields.depth]\nfile = d.asc\n[field.h]\n"
                                     "file = h.asc\nfil = nearest\n[sizes.wave]\nexpression = h\n[sizing]\n"
                                     "type = expression\nexpression = depth + grad(depth)\n");
  EXPECT_EQ(said, "dir/c.ini:3: unknown section [fields.depth]; did you mean 'field.depth'?\n"
                  "dir/c.ini:7: unknown key 'fil' in [field.h]; did you mean 'fill'?\n"
                  "dir/c.ini:8: unknown section [sizes.wave]; did you mean 'size.wave'?");
}

TEST(Config, AcceptsListsWithBlanksOrCommas) {
  const auto solvers = [](const std::string& list) {
    return parse_config(good, "dir/c.ini", {"output.accept=" + list}).accept.size();
  };
  EXPECT_EQ(solvers("none"), 0U);
  EXPECT_EQ(solvers("telemac, fvcom"), 2U);
  EXPECT_EQ(solvers("telemac fvcom,mpas"), 3U);
  expect_refused("output.accept=none telemac", "expected none, or a list of adcirc");
  expect_refused("output.accept=,", "expected none, or a list of adcirc");
}

TEST(Config, RefusesValuesThatMakeNoSense) {
  expect_refused("meshing.points=-5", "expected an integer from 3 to 100000000000");
  expect_refused("meshing.points=2", "expected an integer from 3");
  expect_refused("meshing.points=2e11", "expected an integer from 3");
  expect_refused("meshing.points=5000.5", "expected an integer");
  expect_refused("meshing.points=many", "expected an integer");
  expect_refused("domain.x_min=nan", "expected auto or a number");
  expect_refused("domain.x_min=1", "needs x_min < x_max, found 1 and 1");
  expect_refused("domain.y_max=-1", "needs y_min < y_max");
  expect_refused("domain.cells_x=0", "auto or an integer from 1");
  expect_refused("domain.periodic_x=yes", "expected true or false");
  expect_refused("shape.hole.radius=-1", "expected a number > 0");
  expect_refused("shape.hole.radius=0", "expected a number > 0");
  expect_refused("shape.box.x_max=0.1", "needs x_min < x_max, found 0.1 and 0.1");
  expect_refused("shape.hole.type=circel", "did you mean 'circle'?");
  expect_refused("shape.hole.x_min=1", "'x_min' in [shape.hole] belongs to type rectangle, but the type is circle");
  expect_refused("shape.geometry=difference(box, hol)", "hol");
  expect_refused("shape.geometry=difference(box", "geometry");
  expect_refused("shape.union.type=circle", "'union' cannot name a part");
  expect_refused("shape.2nd.type=circle", "'2nd' cannot name a part");
  expect_refused("meshing.corner_angle=181", "expected a number > 0 and <= 180");
  expect_refused("meshing.initial_fraction=0", "expected auto or a number > 0 and <= 1");
  expect_refused("meshing.stop_tolerance=0", "expected auto or a number > 0");
  expect_refused("meshing.edge_length=0.1", "both 'points' and 'edge_length'");
  expect_refused("meshing.radius=1", "unknown key 'radius' in [meshing]; it belongs to [shape.NAME]");
  expect_refused("output.formats=vtk", "expected a list of");
  expect_refused("output.name=a/b", "without a directory");
  expect_refused("log.level=loud", "expected one of debug, info");
  expect_refused("parallel.setup_threads=-1", "expected an integer from 0");
}

TEST(Config, TheContainerStaysWithinTheRangeOfThePredicates) {
  expect_refused("domain.x_max=1e31", "'x_max = 1e31' in [domain]: expected auto or a number from -1e+30 to 1e+30");
  expect_refused("domain.y_min=-1e300", "'y_min = -1e300' in [domain]: expected auto or a number from -1e+30 to 1e+30");
  expect_refused("domain.x_max=1e-31", "[domain] needs x_max - x_min from 1e-30 to 1e+30, found 1e-31; use");
  expect_refused("domain.y_max=1e-300", "[domain] needs y_max - y_min from 1e-30 to 1e+30, found 1e-300; use");
  EXPECT_NE(errors_of(good, {"domain.x_min=-1e30", "domain.x_max=1e30"}).find("found 2e+30"), std::string::npos);
  EXPECT_EQ(errors_of(good, {"domain.x_min=5", "domain.x_max=1e31"}).find('\n'), std::string::npos)
      << "one error, once";
  for (const char* side : {"1e30", "1e-30"})
    EXPECT_EQ(errors_of(good, {fmt::format("domain.x_max={}", side), fmt::format("domain.y_max={}", side)}), "");
  EXPECT_EQ(errors_of(good, {"domain.x_min=-1e29", "domain.y_min=-1e18"}), "");
  for (const char* text : {"domain.x_max=1e30", "domain.x_min=-1e13", "domain.y_max=1e-30"})
    expect_refused(text, "expected the shorter to be at least 1e-12 of the longer; set");
  EXPECT_EQ(errors_of(good, {"domain.x_min=-1e11"}), "");
}

TEST(Config, AChangedTypeShowsTheKeysThatNoLongerBelong) {
  const std::string message = errors_of(good, {"shape.box.type=triangle"});
  EXPECT_NE(message.find("dir/c.ini:5: 'x_min' in [shape.box] belongs to type rectangle, but the type is triangle"),
            std::string::npos);
}

TEST(Config, RefusesWhatMeansNothing) {
  expect_refused("meshing.fixed_points_normalize_with=box", "has no effect without 'fixed_points'");
  expect_refused("checkpoint.interval=-1", "'interval = -1' in [checkpoint]");
  expect_refused("checkpoint.keep=0", "'keep = 0' in [checkpoint]");
}

TEST(Config, Checkpoints) {
  const CheckpointOptions none = parse_config(good, "c.ini", {}).checkpoint;
  EXPECT_EQ(none.interval, 0);
  EXPECT_EQ(none.keep, 2);
  EXPECT_EQ(none.stop_file, "");
  const CheckpointOptions some =
      parse_config(good, "c.ini", {"checkpoint.interval=60", "checkpoint.keep=3", "checkpoint.stop_file=stop now"})
          .checkpoint;
  EXPECT_EQ(some.interval, 60);
  EXPECT_EQ(some.keep, 3);
  EXPECT_EQ(some.stop_file, "stop now");
}

TEST(Config, TakesTheDefaultsWhenTheyAreSpeltOut) {
  for (const char* text : {"domain.periodic_x=false", "domain.periodic_y=true", "sizing.gradation=0.1",
                           "sizing.gradation=0.0", "parallel.setup_threads=2", "meshing.initial_fraction=1",
                           "output.interval=0", "checkpoint.keep=2", "parallel.setup_threads=0", "meshing.points=1e11"})
    EXPECT_EQ(errors_of(good, {text}), "") << text;
}

TEST(Config, TheContainerIsAutomaticWhereNoSideIsGiven) {
  EXPECT_TRUE(parse_config(good, "c.ini", {}).container_is_automatic);
  EXPECT_TRUE(parse_config(good, "c.ini", {"domain.x_min=auto"}).container_is_automatic);
  EXPECT_FALSE(parse_config(good, "c.ini", {"domain.periodic_x=true"}).container_is_automatic);
  const RunOptions one_side = parse_config(good, "c.ini", {"domain.x_max=3"});
  EXPECT_FALSE(one_side.container_is_automatic);
  EXPECT_EQ(one_side.container.min, (geometry::Vec2{0, 0}));
  EXPECT_EQ(one_side.container.max, (geometry::Vec2{3, 1}));
}

TEST(Config, TakesFormatsOfOtherProgramsButNotForPeriodicContainers) {
  using formats::Format;
  EXPECT_TRUE(parse_config(good, "c.ini", {}).output.export_paths().empty());
  EXPECT_EQ(parse_config(good, "c.ini", {"output.formats=vtkhdf gmsh fort14"}).output.formats,
            (std::vector{Format::vtkhdf, Format::gmsh, Format::adcirc}));
  EXPECT_EQ(parse_config(good, "c.ini", {"output.formats=xdmf gmsh triangle"}).output.export_paths(),
            (std::vector<std::string>{"out/c.msh", "out/c.node", "out/c.ele", "out/c.edge"}));
  EXPECT_NE(errors_of(good, {"output.formats=xdmf vtu", "domain.periodic_y=true"})
                .find("'formats = xdmf vtu' in [output]: a periodic container"),
            std::string::npos);
  for (const formats::FormatInfo& info : formats::all_formats()) {
    EXPECT_EQ(formats::format_of_word(info.word), info.format);
    EXPECT_EQ(formats::format_of_path(std::string("a/b") + info.ending),
              info.plan ? std::optional(info.format) : std::nullopt);
  }
}

TEST(Config, TakesMethodsAndPointSchemes) {
  EXPECT_EQ(parse_config(good, "c.ini", {"meshing.method="}).mesh.method, sweep::Method::hybrid);
  for (const char* method : {"distmesh", "cvd", "hybrid"})
    EXPECT_EQ(method_name(parse_config(good, "c.ini", {std::string("meshing.method=") + method}).mesh.method), method);
  EXPECT_FALSE(parse_config(good, "c.ini", {}).mesh.initial_fraction.has_value());
  EXPECT_EQ(parse_config(good, "c.ini", {"meshing.initial_fraction=0.2"}).mesh.initial_fraction, 0.2);
}

TEST(Config, BoundsOfTheSizeAreInOrder) {
  const auto mesh = parse_config(good, "c.ini", {"sizing.min_size=0.1", "sizing.max_size=0.1"}).mesh;
  EXPECT_EQ(mesh.min_size, 0.1);
  EXPECT_EQ(mesh.max_size, 0.1);
  EXPECT_FALSE(parse_config(good, "c.ini", {}).mesh.max_size.has_value());
  EXPECT_NE(errors_of(good, {"sizing.min_size=0.2", "sizing.max_size=0.1"})
                .find("command line: [sizing] needs min_size <= max_size, found 0.2 and 0.1"),
            std::string::npos);
  expect_refused("sizing.min_size=0", "none or a number > 0");
}

TEST(Config, TheEdgeLengthIsWithinTheBoundsOfTheSize) {
  const auto errors = [](const char* bound) {
    return errors_of("[domain]\nx_min = 0\nx_max = 1\ny_min = 0\ny_max = 1\n[shape]\ngeometry = domain\n"
                     "[meshing]\nedge_length = 0.03\n",
                     {bound});
  };
  EXPECT_NE(errors("sizing.min_size=0.1").find(":9: 'edge_length = 0.03' in [meshing] is below 'min_size = 0.1'"),
            std::string::npos)
      << errors("sizing.min_size=0.1");
  EXPECT_NE(errors("sizing.max_size=0.01").find(":9: 'edge_length = 0.03' in [meshing] is above 'max_size = 0.01'"),
            std::string::npos);
}

TEST(Config, TakesSizes) {
  const RunOptions options = parse_config(good, "dir/c.ini", {"sizing.type=expression", "sizing.expression=1+3*x+3*y"});
  EXPECT_EQ(options.sizing.type, "expression");
  EXPECT_EQ(options.sizing.expression.text, "1+3*x+3*y");
  EXPECT_EQ(options.sizing.expression.place, "command line: 'expression' in [sizing]");
  EXPECT_TRUE(options.warnings.empty());
  EXPECT_EQ(parse_config(good + "[sizing]\ntype = automatic\ngradation = 0.2\n", "c.ini", {}).sizing.gradation, 0.2);
}

TEST(Config, AFormulaThatIsNoneIsToldWithItsLine) {
  const std::string text = good + "[sizing]\ntype = expression\n";
  const std::string sizing = std::to_string(std::count(text.begin(), text.end(), '\n') + 1);
  EXPECT_NE(errors_of(text + "expression = 1+3*x+(\n").find("dir/c.ini:" + sizing + ": 'expression' in [sizing]: "),
            std::string::npos);
  EXPECT_NE(errors_of(text).find("'type = expression' in [sizing] needs 'expression'"), std::string::npos);
  EXPECT_EQ(errors_of(text + "expression = 1+x*z\n", {"sizing.type=uniform"}), "") << "not obeyed, so not read";
}

TEST(Config, KeysWithoutEffectEarnAWarning) {
  const auto warnings = [](const std::vector<std::string>& overrides) {
    return parse_config(good, "dir/c.ini", overrides).warnings;
  };
  ASSERT_EQ(warnings({"sizing.expression=1+x"}).size(), 1u);
  EXPECT_EQ(warnings({"sizing.expression=1+x"})[0], "'expression' in [sizing] has no effect: the type is uniform, not "
                                                    "expression");
  EXPECT_EQ(warnings({"sizing.expression=1+x", "sizing.type=automatic"}).size(), 1u);
  EXPECT_TRUE(warnings({"sizing.gradation=0.1", "sizing.expression=none"}).empty()) << "as printed configs have them";
}

TEST(Config, GradationLimitsEveryTypeOfSize) {
  const auto growth = [](const std::string& sizing) {
    return parse_config(good + "[sizing]\n" + sizing, "c.ini", {}).mesh.gradation;
  };
  EXPECT_FALSE(growth(""));
  EXPECT_EQ(growth("gradation = 0.15\n"), 0.15);
  EXPECT_EQ(growth("type = automatic\n"), 0.1);
  EXPECT_FALSE(growth("type = automatic\ngradation = 0\n")) << "uniform";
  EXPECT_EQ(growth("type = expression\nexpression = 1+x\n"), 0.3);
  EXPECT_EQ(growth("type = expression\nexpression = 1+x\ngradation = 0.2\n"), 0.2);
  EXPECT_FALSE(growth("type = expression\nexpression = 1+x\ngradation = none\n"));
  const auto problem = [](const std::string& sizing) { return errors_of(good + "[sizing]\n" + sizing); };
  EXPECT_NE(problem("type = automatic\ngradation = none\n").find("'gradation = none' in [sizing]: expected a number"),
            std::string::npos);
  EXPECT_NE(problem("type = expression\nexpression = 1+x\ngradation = 0\n").find("expected a number above 0, or none"),
            std::string::npos);
}

TEST(Config, AbsoluteSizesNeedNoNumberOfPoints) {
  const std::string shape = "[shape]\ngeometry = disc\n[shape.disc]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.3\n",
                    absolute = shape + "[sizing]\nscale = absolute\n";
  const RunOptions options = parse_config(absolute + "max_size = 0.1\n", "c.ini", {});
  EXPECT_TRUE(options.mesh.absolute_sizes);
  EXPECT_FALSE(options.mesh.points);
  EXPECT_EQ(parse_config(absolute + "max_size = 0.1\n[meshing]\npoints = 500\n", "c.ini", {}).mesh.points, 500);
  EXPECT_NE(
      errors_of(absolute).find("dir/c.ini:8: 'scale = absolute' in [sizing] with 'type = uniform' needs 'max_size'"),
      std::string::npos)
      << errors_of(absolute);
  EXPECT_NE(errors_of(absolute + "type = automatic\n").find("needs 'min_size'"), std::string::npos);
  EXPECT_NE(errors_of(absolute + "max_size = 0.1\n[meshing]\nedge_length = 0.1\n")
                .find("'edge_length' in [meshing] has no meaning with 'scale = absolute'"),
            std::string::npos);
}

TEST(Config, OutputSaysWhichMeshesAreWritten) {
  const auto options = [](const std::string& interval) {
    return parse_config(good, "dir/c.ini", {"output.interval=" + interval, "output.formats=text xdmf"});
  };
  EXPECT_TRUE(options("-1").output.wants(formats::Format::text));
  EXPECT_FALSE(options("0").write);
  EXPECT_TRUE(options("-1").write);
  EXPECT_FALSE(options("-1").output.steps);
  EXPECT_EQ(options("-1").mesh.snapshot_interval, 0);
  EXPECT_EQ(options("-2").mesh.snapshot_interval, -2);
  EXPECT_TRUE(options("-2").output.steps);
  EXPECT_EQ(options("7").mesh.snapshot_interval, 7);
  EXPECT_TRUE(options("7").write);
}

TEST(Config, ExactlyOneResolution) {
  EXPECT_NE(errors_of(good, {"meshing.points="}).find("set 'points' or 'edge_length'"), std::string::npos);
  EXPECT_EQ(errors_of(good, {"meshing.points=", "meshing.edge_length=0.02"}), "");
  EXPECT_NE(errors_of(good, {"meshing.points=", "meshing.edge_length=1e-9"}).find("asks for about"), std::string::npos);
}

TEST(Config, AnEmptyFileSaysWhatIsMissing) {
  const std::string message = errors_of("");
  EXPECT_NE(message.find("no shape is given"), std::string::npos);
  EXPECT_NE(message.find("set 'points'"), std::string::npos);
}

TEST(Config, APartNeedsItsTypeAndKeys) {
  EXPECT_NE(errors_of(good + "[shape.a]\nradius = 1\n").find("dir/c.ini:16: [shape.a] needs a type: one of"),
            std::string::npos);
  EXPECT_NE(errors_of(good + "[shape.a]\ntype = triangle\np0 = 0 0\np2 = 1 1\n")
                .find("dir/c.ini:16: [shape.a] of type triangle needs 'p1': two numbers"),
            std::string::npos);
  EXPECT_NE(errors_of(good, {"shape.a.radius=1"}).find("command line: [shape.a] needs a type"), std::string::npos);
}

} // namespace
} // namespace trime::app
