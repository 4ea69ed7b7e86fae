// A stage is one line of the table: a stage of this test's own appears in help, --effects, plan, stamps, JSON
// and pixels by it.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/program.h"
#include "pipeline/settings.h"
#include "pipeline/stages/stage_values.h"
#include "support/exr_files.h"

namespace scotopic {
namespace {

using namespace test;

constexpr StageParameter invert_parameters[] = {
    {"invert-white", "image units", 0.001, 1000, 1, "What becomes black (default 1)"}};
constexpr StageDescription invert_description = {"invert", "negative",       "Invert", StageSupport::pixel,
                                                 "RGB",    "its negative",   "never",  "it is a test",
                                                 "",       invert_parameters};

class InvertRows : public RowStage {
 public:
  explicit InvertRows(float white) : white_(white) {}
  void apply(const PixelRows& rows, const RowSight&, std::uint8_t* touched) const override {
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (float* const plane : {rows.r, rows.g, rows.b}) plane[i] = white_ - plane[i];
      touched[i] = 1;
    }
  }

 private:
  float white_;
};

class InvertStage : public PointStage {
 public:
  explicit InvertStage(const StageValues& values) : values_(values) {}
  std::string_view name() const noexcept override { return "invert"; }
  EffectDecision decide(const StageScene&) const override {
    EffectDecision d{.effect = name(), .needed = true};
    d.asked = values_.wish("invert") == EffectWish::yes;
    d.reason = "it is a test";
    return d;
  }
  std::unique_ptr<const RowStage> make(const StageScene&, const Notes&) const override {
    return std::make_unique<const InvertRows>(static_cast<float>(values_.number("invert-white")));
  }
  std::vector<Attribute> stamps(const StageScene&) const override {
    return {{"scotopic:invertWhite", values_.number("invert-white")}};
  }

 private:
  StageValues values_;
};

void add_invert(const StageValues& values, ImageSettings& settings) {
  settings.point_stages.push_back(std::make_shared<const InvertStage>(values));
}

std::vector<StageEntry> with_invert() {
  std::vector<StageEntry> table(shipped_stages().begin(), shipped_stages().end());
  table.insert(table.end() - 1, {&invert_description, nullptr, add_invert});  // the line
  return table;
}

/// A verb's command line with the table, in this process.
class Program {
 public:
  explicit Program(void (*add)(CLI::App&, Invocation&)) : table_(with_invert()) {
    invocation_.stages = table_;
    add(app_, invocation_);
  }
  std::string help() { return app_.get_subcommands({}).front()->help(); }
  /// What it prints on stdout; throws as verbs do.
  std::string run(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());
    app_.parse(arguments);
    testing::internal::CaptureStdout();
    EXPECT_EQ(invocation_.run(), 0);
    return testing::internal::GetCapturedStdout();
  }

 private:
  std::vector<StageEntry> table_;
  CLI::App app_;
  Invocation invocation_;
};

std::string picture(const std::string& name) {
  const std::string file = temporary(name);
  TestPart part;
  part.finite = true;
  for (const char* channel : {"R", "G", "B"}) part.channels.push_back({channel, PixelType::float32});
  write_exr(file, {part});
  return file;
}

TEST(StageTable, a_stage_has_its_options_in_help_and_its_word_in_effects) {
  for (const auto add : {add_apply, add_explain}) {
    const std::string help = Program(add).help();
    EXPECT_NE(help.find("--invert-white X"), std::string::npos) << help;
    EXPECT_NE(help.find("What becomes black (default 1)"), std::string::npos);
    EXPECT_NE(help.find("detail,noise,invert"), std::string::npos);
  }
}

TEST(StageTable, a_stage_runs_where_it_is_named_and_is_told_in_plan_stamps_and_pixels) {
  const std::string in = picture("invert.exr"), out = temporary("invert-out.exr");
  for (const char* word : {"invert", "negative"}) {
    const nlohmann::json report = nlohmann::json::parse(
        Program(add_apply).run({"apply", in, "-o", out, "--adaptation", "100", "--effects", word,
                                "--invert-white", "2", "--json", "-q"}));
    EXPECT_EQ(report["effects"]["invert"]["runs"], true);
    EXPECT_EQ(report["effects"]["invert"]["reason"], "it is a test");
    EXPECT_EQ(report["applied"]["scotopic:invertWhite"], 2.0);
    const std::vector<std::uint32_t> before = read_bits(in, 0, 0, 0, "R"),
                                     after = read_bits(out, 0, 0, 0, "R");
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_EQ(std::bit_cast<float>(after[i]), 2 - std::bit_cast<float>(before[i])) << i;
  }
}

TEST(StageTable, explain_tells_of_it) {
  const std::string in = picture("invert-explain.exr");
  const nlohmann::json report = nlohmann::json::parse(
      Program(add_explain)
          .run({"explain", in, "--adaptation", "1", "--effects", "shift,invert", "--json", "-q"}));
  EXPECT_EQ(report["effects"]["invert"]["asked"], true);
}

TEST(StageTable, values_outside_a_range_are_refused_by_the_parameter_s_name) {
  const std::string in = picture("invert-range.exr");
  for (const auto& [option, value] :
       {std::pair("--invert-white", "0"), std::pair("--invert-white", "x"), std::pair("--seed", "0.5"),
        std::pair("--age", "101"), std::pair("--seed", "-1"), std::pair("--detail", "sharp"),
        std::pair("--effects", "inverted")})
    try {
      (void)Program(add_apply).run({"apply", in, "-o", temporary("no.exr"), option, value, "-q"});
      ADD_FAILURE() << option;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(std::string(option) + ": '" + value + "'"), std::string::npos)
          << error.what();
      (void)testing::internal::GetCapturedStdout();
    }
}

TEST(StageTable, every_parameter_has_a_default_in_its_range_and_a_name_of_its_own) {
  std::vector<std::string_view> names;
  for (const StageEntry& entry : shipped_stages())
    for (const StageParameter& p : entry.description->parameters) {
      EXPECT_TRUE(p.initial >= p.low && p.initial <= p.high) << p.name;
      EXPECT_FALSE(p.sentence.empty()) << p.name;
      if (!p.words.empty()) {
        EXPECT_EQ(p.high, static_cast<double>(p.words.size() - 1)) << p.name;
      }
      EXPECT_EQ(std::count(names.begin(), names.end(), p.name), 0) << p.name;
      names.push_back(p.name);
    }
  EXPECT_GE(names.size(), 15u);
}

}  // namespace
}  // namespace scotopic
