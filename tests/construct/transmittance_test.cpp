// SPDX-License-Identifier: BSD-2-Clause
#include "construct/transmittance.h"

#include "construct/probe.h"

namespace pbrtmedia::test {
namespace {

const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer nz\" 3 \"rgb sigma_s\" [ 0 0 0 ] "
    "\"rgb sigma_a\" [ 2 2 2 ] \"float density\" [ 0.1 0.2 0.3 0.4 0.5 0.6 ] ";

Attempt with(const std::string& parameters) {
  return attemptWorld("MakeNamedMedium \"m\" " + kGrid + parameters +
                      "\nMediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"");
}

std::string quoted(const ParameterDescription& d) {
  const std::string value = d.type == "string" || d.type == "bool" ? '"' + d.value + '"' : d.value;
  return " \"" + d.type + " " + d.name + "\" " + value;
}

TEST(ConstructTransmittance, EveryEstimatorOfTheListCanBeNamedWithItsParametersAndLaws) {
  for (const std::string_view name : estimatorNames()) {
    const std::string named = "\"string transmittance\" \"" + std::string(name) + "\"";
    const AnyEstimator estimator = *findEstimator(name);
    std::string all = named;
    for (const ParameterDescription& d : parametersOf(estimator)) all += quoted(d);
    const Attempt bare = with(named), spelled = with(all);
    ASSERT_TRUE(bare.made) << name << ": " << bare.messages();
    ASSERT_TRUE(spelled.made) << name << ": " << spelled.messages();
    EXPECT_EQ(media(bare), media(spelled)) << name;
    EXPECT_NE(mediumOf(bare)->describe().find(name), std::string::npos) << mediumOf(bare)->describe();
    const EstimatorTraits traits = traitsOf(estimator);
    if (traits.bias == EstimatorTraits::Bias::Unbiased) {
      EXPECT_TRUE(bare.isSilent()) << bare.messages();
    } else {
      EXPECT_TRUE(bare.warns("\" is " + std::string(nameOf(traits.bias)))) << bare.messages();
    }
    for (const std::string_view law : lawNames()) {
      const Attempt under = with(named + " \"string law\" \"" + std::string(law) + "\"");
      EXPECT_EQ(under.made.has_value(), traits.laws.has(*findLaw(law))) << name << " under " << law;
    }
  }
}

TEST(ConstructTransmittance, ALawChangesTheMedium) {
  const std::string regular = "\"string transmittance\" \"regular\" ";
  for (const std::string law : {"pinknoise", "davis", "linear", "mixture"}) {
    EXPECT_NE(media(with(regular)), media(with(regular + "\"string law\" \"" + law + "\""))) << law;
  }
  EXPECT_EQ(media(with(regular)), media(with(regular + "\"string law\" \"exponential\"")));
  EXPECT_NE(media(with(regular + "\"string law\" \"pinknoise\"")),
            media(with(regular + "\"string law\" \"pinknoise\" \"float correlation\" 0.9")));
}

TEST(ConstructTransmittance, TheBaseOfAnEstimatorBringsItsParameters) {
  const std::string gamma = "\"string transmittance\" \"gamma\" ";
  EXPECT_TRUE(with(gamma + "\"string base\" \"johnson\" \"integer n\" 5").isSilent());
  EXPECT_TRUE(with(gamma + "\"string base\" \"johnson\" \"integer tuplesize\" 5").warns("tuplesize"));
  EXPECT_NE(media(with(gamma + "\"string base\" \"johnson\"")),
            media(with(gamma + "\"string base\" \"johnson\" \"integer n\" 50")));
}

TEST(ConstructTransmittance, IsAutomaticWhereNobodyNamesIt) {
  const auto described = [](const std::string& parameters) { return mediumOf(with(parameters))->describe(); };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << " has no " << part;
  };
  has(described(""), "estimator regular (auto)");
  EXPECT_EQ(described(""), described("\"string transmittance\" \"auto\""));
  EXPECT_EQ(described("").find("law"), std::string::npos);
  // Parameters alone are those of ratio tracking.
  has(described("\"float roulettethreshold\" .5"), "estimator ratio,");
  // Nothing is known of bounds that are learned.
  has(described("\"string bounds\" \"progressive\""), "estimator ratio (auto)");
  // A law is served.
  has(described("\"string law\" \"pinknoise\""), "estimator regular (law pinknoise)");
  has(mediumOf(
          attemptWorld("MakeNamedMedium \"m\" \"string type\" \"perlin\" \"rgb sigma_s\" [ 0 0 0 ] "
                       "\"string law\" \"davis\" MediumInterface \"m\" \"\" Material \"\" Shape \"sphere\""))
          ->describe(),
      "estimator debiased-ray-marching (law davis)");
}

TEST(ConstructTransmittance, SaysWhatIsWrong) {
  expectMistakes(
      {{"\"string transmittance\" \"ratoi\"", "unknown estimator \"ratoi\"; did you mean \"ratio\"?", ""},
       {"\"string transmittance\" \"ratio\" \"float roulettethreshold\" 2",
        "\"roulettethreshold\": found 2, expected a number 0 to 1", ""},
       {"\"string transmittance\" \"ratio\" \"integer maxlookups\" -1",
        "found -1, expected a whole number at least 0", ""},
       {"\"string transmittance\" \"regular\" \"float roulettethreshold\" 0.5",
        "unknown parameter \"roulettethreshold\"", "", kTolerated},
       {"\"string transmittance\" \"ratio\" \"string law\" \"pinknoise\"",
        "estimator \"ratio\" serves exponential; the law \"pinknoise\" is served by", ""},
       {"\"string transmittance\" \"regular\" \"string law\" \"pinknose\"", "did you mean \"pinknoise\"?",
        ""},
       {"\"string transmittance\" \"regular\" \"string law\" \"pinknoise\" \"float correlation\" -1",
        "\"correlation\": found -1, expected a number", ""},
       {"\"string transmittance\" \"auto\" \"float roulettethreshold\" 0.5",
        "unknown parameter \"roulettethreshold\"", "", kTolerated},
       {"\"float roulettethreshold\" 2", "found 2, expected a number 0 to 1", ""},
       {"\"string transmittance\" \"aut\"", "did you mean \"auto\"?", ""}},
      with);
}

}  // namespace
}  // namespace pbrtmedia::test
