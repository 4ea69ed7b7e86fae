// LUT files: what is written is what was measured, the same bytes each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <locale>
#include <sstream>

#include "looks/chain/chain_text.h"
#include "looks/verify/inspect.h"
#include "looks/lut/shipped_looks.h"
#include "looks/lut/look_chain.h"
#include "looks/lut/look_spec.h"
#include "looks/chain/number_text.h"
#include "looks/chain/ocio_chain.h"
#include "looks/chain/read_back.h"
#include "looks/support.h"
#include "base/error.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

TEST(NumberText, shortest_fixed_and_rounded) {
  EXPECT_EQ(number_text(0.1f), "0.1");
  EXPECT_EQ(number_text(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(fixed_text(0.25, 6), "0.25");
  EXPECT_EQ(fixed_text(-0.0000001, 6), "0");
  EXPECT_EQ(fixed_text(-3, 6), "-3");
  EXPECT_EQ(fixed_text(100, 0), "100");
  EXPECT_EQ(rounded_text(0.0345678, 2), "0.035");
}

TEST(Chain, is_rounded_as_files_have_it_without_minus_nought) {
  Chain chain;
  chain.steps = {Lut3DStep{1, {-1e-9, 0.12345678, -0.25}, 6}};
  round_as_written(chain);
  const std::vector<double>& got = std::get<Lut3DStep>(chain.steps[0]).values;
  EXPECT_FALSE(std::signbit(got[0]));
  EXPECT_EQ(got, (std::vector<double>{0, 0.123457, -0.25}));
}

LookSpec some_spec() {
  LookSpec spec;
  spec.parameters = test::adapted_to(0.03, "ap1", Model::kirk2011);
  spec.parameters.strength = {0.9, 0.8, 0.7, 0.6};
  spec.parameters.weight = Weight::global;
  spec.parameters.luminance = LuminancePolicy::photopic;
  spec.parameters.rods = RodEstimate::quadratic;
  spec.parameters.sp_ratio = 0.645;
  spec.space = "ACEScg";
  spec.gamut = "ap1";
  spec.edge = 17;
  return spec;
}

TEST(LookSpec, its_text_reads_back_whole) {
  const LookSpec spec = some_spec();
  const std::string text = spec_text(spec);
  const auto back = read_spec("<Description>" + text + "</Description>");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(spec_text(*back), text);
  EXPECT_EQ(back->parameters.xyz_from_rgb.rows, spec.parameters.xyz_from_rgb.rows);
  LookSpec open = spec;
  open.parameters.xyz_from_gamut.reset();
  EXPECT_FALSE(read_spec(spec_text(open))->parameters.xyz_from_gamut.has_value());
}

TEST(LookSpec, damaged_text_is_refused) {
  const std::string text = spec_text(some_spec());
  ASSERT_TRUE(read_spec(text));
  EXPECT_FALSE(read_spec(""));
  EXPECT_FALSE(read_spec(text.substr(0, text.size() / 2)));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string damaged = text;
    damaged.replace(damaged.find(from), from.size(), to);
    return read_spec(damaged).has_value();
  };
  EXPECT_TRUE(with("adaptation=0.03", "adaptation=0.04"));
  EXPECT_FALSE(with("adaptation=0.03", "adaptation=nan"));
  EXPECT_FALSE(with("adaptation=0.03", "adaptation=-1"));
  EXPECT_FALSE(with("adaptation=0.03", "adaptation="));
  EXPECT_FALSE(with("model=kirk2011", "model=kirk"));
  EXPECT_FALSE(with("edge=17", "edge=100000"));
  EXPECT_FALSE(with("strength=0.9", "strength=2"));
}

TEST(LookFiles, clf_and_ctf_read_back_as_the_chain_that_was_measured) {
  const AppearanceParameters p = test::adapted_to(0.05);
  Chain chain = look_chain(p, 17);
  chain.id = chain.name = "test";
  const auto direct = cpu_processor(ocio_transform(chain), OCIO::Config::CreateRaw());
  const test::Folder folder;
  for (const auto& [name, format] : {std::pair{"a.clf", ChainFormat::clf}, {"a.ctf", ChainFormat::ctf}}) {
    const auto read = lut_processor(folder.write(name, xml_text(chain, format)));
    const Colours in = stop_colours(5000, p.xyz_from_rgb, p.xyz_from_rgb);
    Colours a = in, b = in;
    apply(direct, a);
    apply(read, b);
    EXPECT_EQ(a.r, b.r) << name;
    EXPECT_EQ(a.g, b.g) << name;
    EXPECT_EQ(a.b, b.b) << name;
  }
}

/// A locale that writes half as 0,5, made by localedef into a folder of its own; in force for C and C++ while
/// it stands.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale()) {
    const std::string command = "localedef --quiet -i de_DE -f UTF-8 " + folder_.path("de_DE.UTF-8");
    EXPECT_EQ(std::system(command.c_str()), 0) << "Debian's package locales has what localedef reads";
    setenv("LOCPATH", folder_.path("").c_str(), 1);
    std::locale::global(std::locale("de_DE.UTF-8"));
  }
  ~CommaLocale() {
    std::locale::global(before_);
    unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  test::Folder folder_;
  std::locale before_;
};

TEST(LookFiles, no_locale_changes_a_byte) {
  const auto texts = [] {
    const Chain chain = look_chain(test::adapted_to(0.05), 17);
    Lut3DStep lut{2, std::vector<double>(24, 0.5), 3};
    return std::vector<std::string>{xml_text(chain, ChainFormat::clf),
                                    xml_text(chain, ChainFormat::ctf),
                                    spi3d_text(lut),
                                    number_text(0.5),
                                    fixed_text(12345.5, 3),
                                    rounded_text(0.5, 2)};
  };
  const std::vector<std::string> expected = texts();
  const CommaLocale locale;
  std::ostringstream by_stream;
  by_stream << 0.5;
  char by_printf[8];
  std::snprintf(by_printf, sizeof by_printf, "%.1f", 0.5);
  ASSERT_EQ(by_stream.str(), "0,5");
  ASSERT_EQ(std::string(by_printf), "0,5");
  EXPECT_EQ(texts(), expected);
}

TEST(LookFiles, the_clf_says_tetrahedral_and_starts_with_a_range) {
  const std::string text = xml_text(look_chain(test::adapted_to(0.05), 17), ChainFormat::clf);
  EXPECT_NE(text.find("<LUT3D inBitDepth=\"32f\" outBitDepth=\"32f\" interpolation=\"tetrahedral\">"),
            std::string::npos);
  EXPECT_LT(text.find("<Range"), text.find("<Matrix"));
}

TEST(LookFiles, plain_formats_hold_one_cube_in_their_own_order) {
  Chain chain;
  chain.name = "identity";
  Lut3DStep lut{2, {}, 3};
  for (const double r : {0., 1.})
    for (const double g : {0., 1.})
      for (const double b : {0., 1.}) lut.values.insert(lut.values.end(), {r, g, b});
  chain.steps = {RangeStep{0, 1}, lut};
  EXPECT_NE(cube_text(chain).find("LUT_3D_SIZE 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n"), std::string::npos);
  EXPECT_NE(spi3d_text(lut).find("2 2 2\n0 0 0 0 0 0\n0 0 1 0 0 1\n"), std::string::npos);
  EXPECT_THROW((void)cube_text(look_chain(test::adapted_to(0.05), 17)), std::logic_error);
}

/// Every number that stands outside words in a LUT's text.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (std::strchr("0123456789-+.naif", text[at]) == nullptr) continue;
    if (at > 0 && std::strchr(" \n>", text[at - 1]) == nullptr) continue;
    char* end = nullptr;
    const double value = std::strtod(text.c_str() + at, &end);
    const auto stop = static_cast<std::size_t>(end - text.c_str());
    if (stop > at && (stop == text.size() || std::strchr(" \n<", text[stop]) != nullptr))
      out.push_back(value);
    at = std::max(at, stop);
  }
  return out;
}

TEST(LookFiles, no_number_is_infinite_or_nan_or_subnormal_however_extreme_the_light) {
  std::size_t numbers = 0;
  for (const Model model : {Model::filament2021, Model::kirk2011, Model::safko2019, Model::cao2008})
    for (const double adaptation : {1e-9, 1e-3, 4.9, 5.0, 1e9})
      for (const double white : {1e-9, 1.0, 1e9}) {
        AppearanceParameters p = test::adapted_to(adaptation, "rec709", model);
        p.white_luminance = white;
        std::string text;
        try {
          text = xml_text(look_chain(p, 17), ChainFormat::clf);
        } catch (const Error& e) {
          EXPECT_EQ(e.code(), ExitCode::check_failed) << e.what();
          continue;
        }
        for (const double value : numbers_in(text)) {
          const auto single = static_cast<float>(value);
          ASSERT_TRUE(single == 0 || std::isnormal(single)) << value << " at " << adaptation << ", " << white;
          ++numbers;
        }
      }
  EXPECT_GT(numbers, 45u * 17 * 17 * 17);
}

TEST(LookFiles, numbers_that_floats_cannot_hold_are_refused_or_nothing) {
  Chain chain;
  chain.steps = {MatrixStep{diagonal<double>({1e-40, 1, 1}), {}}};
  EXPECT_NE(xml_text(chain, ChainFormat::clf).find("0 0 0\n0 1 0"), std::string::npos)
      << xml_text(chain, ChainFormat::clf);
  for (const double odd : {1e39, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    chain.steps = {MatrixStep{diagonal<double>({odd, 1, 1}), {}}};
    EXPECT_THROW((void)xml_text(chain, ChainFormat::clf), Error) << odd;
    Lut3DStep lut{2, std::vector<double>(24, odd), 6};
    EXPECT_THROW((void)spi3d_text(lut), Error) << odd;
  }
}

TEST(ReadBack, what_a_file_holds_is_what_was_meant_to_the_last_bit) {
  const AppearanceParameters p = test::adapted_to(0.05);
  Chain chain = look_chain(p, 17);
  chain.id = chain.name = "test";
  const test::Folder folder;
  const std::string text = xml_text(chain, ChainFormat::clf);
  EXPECT_NO_THROW(require_read_back(folder.write("a.clf", text), "a.clf", chain));
  // One digit of one number; a file cut; no file.
  std::string changed = text;
  const std::size_t digit = text.find('.', text.find("<LUT3D")) + 2;
  changed[digit] = changed[digit] == '5' ? '6' : '5';
  EXPECT_THROW(require_read_back(folder.write("b.clf", changed), "b.clf", chain), Error);
  EXPECT_THROW(require_read_back(folder.write("c.clf", text.substr(0, text.size() / 2)), "c.clf", chain),
               Error);
  EXPECT_THROW(require_read_back(folder.path("none.clf"), "none.clf", chain), Error);
  EXPECT_THROW(require_config("ocio_profile_version: 2\n", "x.ocio"), Error);
}

TEST(Inspection, a_lut_that_is_worse_than_it_says_fails_and_strangers_are_refused) {
  const ColourConfig config = ColourConfig::own();
  LookSpec spec;
  spec.parameters = test::adapted_to(0.1);
  spec.space = config.working_space();
  spec.edge = 17;
  const BakedLook baked = bake_look(spec, config, "test");
  std::string text = xml_text(baked.chain, ChainFormat::clf);
  const test::Folder folder;
  EXPECT_TRUE(inspect_lut(folder.write("good.clf", text), config).problems.empty());
  // The same LUT, said to be of another luminance.
  std::string wrong = text;
  wrong.replace(wrong.find("adaptation=0.1;"), 15, "adaptation=0.2;");
  EXPECT_FALSE(inspect_lut(folder.write("wrong.clf", wrong), config).problems.empty());
  EXPECT_THROW((void)inspect_lut(folder.write("other.clf", "<ProcessList/>"), config), Error);
  EXPECT_THROW((void)inspect_lut(folder.write("cut.clf", text.substr(0, text.size() / 2)), config), Error);
  EXPECT_THROW((void)inspect_lut(folder.path("none.clf"), config), Error);
}

TEST(Ladder, names_are_what_ocio_s_list_of_looks_can_hold) {
  for (const Model model : {Model::filament2021, Model::kirk2011})
    for (const NamedAdaptation& step : named_adaptations) {
      const std::string name = look_name(test::adapted_to(step.adaptation, "rec709", model));
      EXPECT_EQ(name.find_first_of(",:|/"), std::string::npos) << name;
      EXPECT_EQ(name.find(" - "), std::string::npos) << name;
      EXPECT_LT(name.size(), 60u);
      EXPECT_TRUE(std::isalpha(name[0]));
    }
  EXPECT_EQ(look_name(test::adapted_to(0.1)), "Mesopic 0.1 nit (street lighting)");
  EXPECT_EQ(look_name(test::adapted_to(0.05)), "Mesopic 0.05 nit");
}

}  // namespace
}  // namespace scotopic
