#include "report/fracture_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nacre::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TestedDesign tested(const char* design, double modulus_pa, double toughness_pa) {
  TestedDesign result{.design = pattern::design_from_argument(design), .modulus_pa = modulus_pa, .fracture = {}};
  result.fracture.toughness_pa = toughness_pa;
  result.fracture.failure_strain = 0.3;
  result.fracture.curve = {.strain = {0.0, 0.3}, .stress_pa = {0.0, 1e6}};
  return result;
}

BrokenSpecimen broken(int separate_cracks, bool crosses) {
  BrokenSpecimen specimen{
      .tested = tested("577fffe9fffdef", 1.5e9, 0.15e6), .reference = tested("rigid", 3e9, 0.03e6), .crack = {}};
  specimen.crack.path.emplace().crosses = crosses;
  specimen.crack.separate_cracks = separate_cracks;
  return specimen;
}

/// What stands in the page's data address of a GIF.
std::string encoded(const std::string& gif) {
  const std::string page = render_fracture_page(broken(0, true), gif), before = "data:image/gif;base64,";
  const auto begin = page.find(before) + before.size();
  return page.substr(begin, page.find('"', begin) - begin);
}

TEST(FracturePage, TheSentenceSaysWhatTheCrackDoesAndWhatItTakes) {
  EXPECT_EQ(fracture_in_words(broken(12, true)),
            "From the notch the crack runs through the whole specimen, while 12 further cracks open elsewhere: it "
            "takes 5 times the energy that breaks rigid material alone, at 0.5 times its stiffness.");
  EXPECT_THAT(fracture_in_words(broken(0, false)), AllOf(HasSubstr("part of the way:"), Not(HasSubstr("elsewhere"))));
  EXPECT_THAT(fracture_in_words(broken(1, true)), HasSubstr("another crack opens elsewhere"));
}

TEST(FracturePage, WhatDoesNotBreakIsNotSaidToBreak) {
  BrokenSpecimen unbroken = broken(0, false);
  unbroken.crack.path.reset();
  EXPECT_EQ(fracture_in_words(unbroken), "Nothing breaks up to 30 % of strain.");
}

TEST(FracturePage, AMaterialIsNotComparedWithItself) {
  BrokenSpecimen same = broken(0, true);
  same.tested = same.reference;
  EXPECT_EQ(fracture_in_words(same), "From the notch the crack runs through the whole specimen.");
}

TEST(FracturePage, TheFilmStandsInThePageAndNothingComesFromOutside) {  // vectors of RFC 4648, section 10
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("\xff\xfe"), "//4=");
  EXPECT_THAT(render_fracture_page(broken(0, true), "GIF"),
              AllOf(HasSubstr("<svg"), Not(HasSubstr("http://")), Not(HasSubstr("https://"))));
}

}  // namespace
}  // namespace nacre::report
