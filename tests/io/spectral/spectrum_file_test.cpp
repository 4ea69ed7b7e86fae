#include "io/spectral/spectrum_file.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace scotopic {
namespace {

double at(const std::string& text, double nm) { return spectrum_from_text(text, "lamp.csv").curve().at(nm); }

TEST(SpectrumFile, separators_titles_and_comments_make_no_difference) {
  for (const char* text :
       {"400,1\n500,3\n", "400;1\r\n500;3\r\n", "400\t1\n500\t3", "  400   1 \n 500 3\n\n",
        "nm,power\n400,1\n500,3\n", "# measured\nwavelength (nm), W\n400, 1\n# half way\n500, 3\n",
        "4e2,1\n5e2,.3e1\n"}) {
    EXPECT_EQ(at(text, 400), 1.0) << text;
    EXPECT_EQ(at(text, 450), 2.0) << text;
    EXPECT_EQ(at(text, 500), 3.0) << text;
    EXPECT_EQ(at(text, 399), 0.0) << text;
    EXPECT_EQ(at(text, 501), 0.0) << text;
  }
}

TEST(SpectrumFile, a_line_narrower_than_a_nanometre_keeps_its_power) {
  // A triangle of area .2 around 589.3 nm.
  const std::string text = "588,0\n589.1,0\n589.3,1\n589.5,0\n591,0\n";
  const Spectrum spectrum = spectrum_from_text(text, "lamp.csv");
  double area = 0.0;
  for (const double value : spectrum.values) area += value;
  EXPECT_NEAR(area, 0.2, 1e-12);
  EXPECT_NEAR(spectrum.curve().at(589), 0.2, 1e-12);
}

TEST(SpectrumFile, faults_are_named_with_their_line) {
  struct Row {
    const char* text;
    const char* message;
  };
  for (const Row& row :
       {Row{"", "fewer than two rows"}, Row{"400,1\n", "fewer than two rows"},
        Row{"a,b\nc,d\n", "line 2: not two"}, Row{"400,1\n500,x\n", "line 2: not two"},
        Row{"400,1,2\n500,1,2\n", "line 1: not two"},
        Row{"400,1\n\n400,2\n", "line 3: wavelengths do not ascend"}, Row{"500,1\n400,2\n", "do not ascend"},
        Row{"400,1\n500,-2\n", "line 2: the power"}, Row{"400,1\n500,nan\n", "line 2: the power"},
        Row{"-4,1\n500,1\n", "line 1: the wavelength"}, Row{"400,1\n1e999,1\n", "line 2: not two"},
        Row{"400,0\n500,0\n", "no visible light"}, Row{"2000,1\n3000,1\n", "no visible light"}}) {
    try {
      spectrum_from_text(row.text, "lamp.csv");
      ADD_FAILURE() << row.text << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input);
      EXPECT_NE(std::string(error.what()).find(row.message), std::string::npos)
          << row.text << ": " << error.what() << ", expected: " << row.message;
    }
  }
}

TEST(SpectrumFile, a_missing_file_is_an_input_error) {
  EXPECT_THROW(read_spectrum_file("/nonexistent/lamp.csv"), Error);
}

}  // namespace
}  // namespace scotopic
