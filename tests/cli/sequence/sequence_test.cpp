// A sequence in one process is what its frames are one by one.
#include "cli/sequence/sequence.h"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace scotopic {
namespace {

using test::Outcome;

class Frames : public test::Sequence {};

TEST_F(Frames, each_has_the_bytes_it_has_by_itself_at_any_number_at_once) {
  write_frames(7, 1.3);
  ASSERT_EQ(apply({"--frames", "1-7", "--adaptation", "0.1"}).exit_code, 0);
  std::map<std::string, std::string> first;
  for (int f = 1; f <= 7; ++f) {
    const std::string name = "seen.000" + std::to_string(f) + ".exr";
    first[name] = bytes(name);
    ASSERT_FALSE(first[name].empty());
  }
  for (const char* at_once : {"1", "5"})
    for (const char* threads : {"1", "3"}) {
      ASSERT_EQ(
          apply({"--frames", "1-7", "--adaptation", "0.1", "--frames-at-once", at_once, "--threads", threads})
              .exit_code,
          0);
      for (const auto& [name, expected] : first)
        EXPECT_EQ(bytes(name), expected) << name << " " << at_once << " " << threads;
    }
  // One alone, stamped as frames of a sequence are.
  ASSERT_EQ(run({"apply", "{}/in.0003.exr", "-o", "{}/seen.0003.exr", "--white-luminance", "1",
                 "--adaptation", "0.1", "--skip-existing"})
                .exit_code,
            0);
  EXPECT_EQ(bytes("seen.0003.exr"), first["seen.0003.exr"]);
}

TEST_F(Frames, patterns_of_input_and_output_need_not_be_of_one_kind) {
  write_frames(3);
  ASSERT_EQ(run({"apply", "{}/in.%04d.exr", "-o", "{}/out@@.exr", "--frames", "1-3x2", "--adaptation", "1"})
                .exit_code,
            0);
  EXPECT_TRUE(exists("out01.exr"));
  EXPECT_FALSE(exists("out02.exr"));
  EXPECT_TRUE(exists("out03.exr"));
}

TEST_F(Frames, without_frames_a_name_is_a_name) {
  for (const char* name : {"a%04d.exr", "b.####.exr", "c@@.exr"}) {
    test::write_scaled_picture(path(name), 16, 16, 1);
    const std::string out = std::string("out-") + name;
    ASSERT_EQ(run({"apply", "{}/" + std::string(name), "-o", "{}/" + out, "--adaptation", "1"}).exit_code, 0)
        << name;
    EXPECT_TRUE(exists(out));
  }
}

TEST_F(Frames, hostile_names_are_only_names) {
  const std::string hostile = "%s%n {0}$(touch x)\n'\"-";
  test::write_scaled_picture(path(hostile + "01.exr"), 16, 16, 1);
  const Outcome outcome =
      run({"apply", folder_ + "/" + hostile + "##.exr", "-o", folder_ + "/seen " + hostile + "##.exr",
           "--frames", "1", "--adaptation", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(exists("seen " + hostile + "01.exr"));
}

TEST_F(Frames, those_with_pixels_that_are_not_finite_are_named_at_the_end) {
  write_frames(4);
  for (const char* name : {"in.0002.exr", "in.0004.exr"})
    test::write_scaled_picture(path(name), 48, 40, std::numeric_limits<double>::infinity());
  const Outcome outcome = apply({"--frames", "1-4", "--adaptation", "0.1"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("4 of 4 frames written, 2 with pixels that are not finite (2, 4)"),
            outcome.err.npos)
      << outcome.err;
}

TEST_F(Frames, missing_ones_are_named_before_anything_is_computed) {
  write_frames(6);
  for (const char* gone : {"in.0002.exr", "in.0005.exr"}) std::filesystem::remove(path(gone));
  const Outcome outcome = apply({"--frames", "1-6", "--adaptation", "0.1"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err, "scotopic: " + path("in.0002.exr") +
                             ": No such file or directory: missing are frames 2, 5 (nothing written)\n");
  EXPECT_EQ(files("seen"), 0u);
  EXPECT_EQ(apply({"--frames", "2", "--adaptation", "0.1"}).err,
            "scotopic: " + path("in.0002.exr") +
                ": No such file or directory: missing is frame 2 (nothing written)\n");
}

TEST_F(Frames, a_failure_stops_the_sequence_and_what_is_written_is_whole) {
  write_frames(6);
  write("in.0003.exr", bytes("in.0003.exr").substr(0, 400));
  const Outcome outcome = apply({"--frames", "1-6", "--adaptation", "0.1", "--frames-at-once", "1"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("in.0003.exr: is "), std::string::npos) << outcome.err;
  // The next one may be under way by then: it is finished.
  const bool two = outcome.err.find("2 of 6 frames written, 1 failed (3), 3 not begun") != std::string::npos;
  const bool three =
      outcome.err.find("3 of 6 frames written, 1 failed (3), 2 not begun") != std::string::npos;
  EXPECT_TRUE(two || three) << outcome.err;
  EXPECT_TRUE(exists("seen.0002.exr"));
  EXPECT_FALSE(exists("seen.0003.exr"));
  EXPECT_EQ(files(".scotopic"), 0u);
}

TEST_F(Frames, continue_on_error_goes_on_and_ends_with_the_first_failures_code) {
  write_frames(6);
  write("in.0002.exr", "no image");
  std::filesystem::remove(path("in.0005.exr"));
  const Outcome outcome = apply({"--frames", "1-6", "--adaptation", "0.1", "--continue-on-error", "--json"});
  EXPECT_EQ(outcome.exit_code, 3);
  const nlohmann::json result = nlohmann::json::parse(outcome.out);
  using Statuses = std::map<int, std::string>;
  EXPECT_EQ(
      statuses(result),
      (Statuses{
          {1, "written"}, {2, "failed"}, {3, "written"}, {4, "written"}, {5, "failed"}, {6, "written"}}));
  EXPECT_EQ(result["written"], 4);
  EXPECT_EQ(result["failed"], 2);
  EXPECT_EQ(result["frames"][1]["code"], 3);
  EXPECT_NE(outcome.err.find("4 of 6 frames written, 2 failed (2, 5)"), std::string::npos) << outcome.err;
  EXPECT_EQ(files("seen"), 4u);
  // A limit comes first: its code is the program's.
  EXPECT_EQ(apply({"--frames", "1,2", "--adaptation", "0.1", "--continue-on-error", "--max-pixels", "10"})
                .exit_code,
            4);
}

TEST_F(Frames, wrong_patterns_and_lists_are_usage_errors_and_nothing_is_written) {
  write_frames(3);
  const std::vector<std::pair<std::vector<std::string>, std::string>> rows = {
      {{"{}/in.0001.exr", "-o", "{}/seen.####.exr", "--frames", "1-3"},
       "the input has no place for the frame's number"},
      {{"{}/in.####.exr", "-o", "{}/seen.exr", "--frames", "1-3"},
       "the output has no place for the frame's number"},
      {{"{}/in.####.exr", "-o", "{}/seen.%s.exr", "--frames", "1-3"}, "the output has no place"},
      {{"{}/in.####.exr", "-o", "{}/seen.####.gif", "--frames", "1-3"}, "must be named"},
      {{"{}/in.####.exr", "-o", "{}/seen.####.exr", "--frames", "3-1"}, "runs backwards"},
      {{"{}/in.####.exr", "-o", "{}/seen.####.exr", "--frames", "one"}, "is not a list of frames"},
      {{"{}/in.####.exr", "-o", "{}/seen.####.exr", "--frames", "1-3", "--frames-at-once", "0"},
       "--frames-at-once"},
      {{"{}/in.####.exr", "-o", "{}/in.####.exr", "--frames", "1-3", "--skip-existing"},
       "cannot tell what is done"},
      {{"{}/in.0001.exr", "-o", "{}/in.0001.exr", "--skip-existing"}, "cannot tell what is done"},
      {{"{}/in.0001.exr", "-o", "{}/seen.exr", "--adaptation-from", "frames"}, "needs --frames"},
  };
  for (const auto& [words, says] : rows) {
    std::vector<std::string> arguments = {"apply"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    arguments.insert(arguments.end(), {"--white-luminance", "1"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(files(""), 3u);
}

TEST_F(Frames, no_frames_output_may_be_another_frames_input) {
  for (const char* name : {"f.1.exr", "f.2.exr", "f.11.exr", "f.12.exr"})
    test::write_scaled_picture(path(name), 16, 16, 1);
  const Outcome outcome =
      run({"apply", "{}/f.%d.exr", "-o", "{}/f.1%d.exr", "--frames", "1-2,11", "--adaptation", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("would be frame 1's output and is frame 11's input"), std::string::npos)
      << outcome.err;
  // In place is well defined.
  EXPECT_EQ(
      run({"apply", "{}/f.%d.exr", "-o", "{}/f.%d.exr", "--frames", "1-2", "--adaptation", "1"}).exit_code,
      0);
}

TEST_F(Frames, a_folder_that_cannot_be_written_is_told_before_metering) {
  write_frames(2);
  const Outcome outcome = run({"apply", "{}/in.####.exr", "-o", "{}/none/seen.####.exr", "--frames", "1-2",
                               "--white-luminance", "1", "--adaptation-from", "frames"});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(Frames, what_is_true_of_all_frames_is_said_once) {
  write_frames(5);
  const std::string err = apply({"--frames", "1-5", "--adaptation", "0.1"}).err;
  const std::string plan = ": shift, luminance, chroma";
  ASSERT_NE(err.find(plan), std::string::npos) << err;
  EXPECT_EQ(err.find(plan), err.rfind(plan)) << err;
  for (int f = 1; f <= 5; ++f)
    EXPECT_NE(err.find("seen.000" + std::to_string(f) + ".exr: written (" + std::to_string(f) + " of 5"),
              std::string::npos)
        << err;
  EXPECT_EQ(apply({"--frames", "1-5", "--adaptation", "0.1", "-q"}).err, "");
}

TEST_F(Frames, lines_are_heard_while_pngs_are_read_two_at_once) {
  // While libpng is kept from speaking, nobody else may be.
  write_frames(8, 1, 256, 256);
  ASSERT_EQ(
      run({"apply", "{}/in.####.exr", "-o", "{}/p.####.png", "--frames", "1-8", "--adaptation", "1", "-q"})
          .exit_code,
      0);
  write("p.0004.png", bytes("p.0004.png").substr(0, 2000));
  const Outcome outcome = run({"apply", "{}/p.####.png", "-o", "{}/q.####.png", "--frames", "1-8",
                               "--adaptation", "1", "--continue-on-error", "--frames-at-once", "4"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("p.0004.png: is "), std::string::npos) << outcome.err;
  for (const int f : {1, 2, 3, 5, 6, 7, 8})
    EXPECT_NE(outcome.err.find("q.000" + std::to_string(f) + ".png: written"), std::string::npos)
        << outcome.err;
  EXPECT_NE(outcome.err.find("7 of 8 frames written, 1 failed (4)"), std::string::npos) << outcome.err;
}

TEST_F(Frames, receptor_signals_come_in_sequences_too) {
  write_frames(3, 2);
  ASSERT_EQ(run({"lmsr", "{}/in.####.exr", "-o", "{}/l.####.exr", "--frames", "1-3", "-q"}).exit_code, 0);
  EXPECT_EQ(files("l.000"), 3u);
  const Outcome again = run({"lmsr", "{}/in.####.exr", "-o", "{}/l.####.exr", "--frames", "1-3",
                             "--skip-existing", "--json", "-q"});
  EXPECT_EQ(nlohmann::json::parse(again.out)["skipped"], 3) << again.out;
}

}  // namespace
}  // namespace scotopic
