// Every option and attribute that docs/rib_support.md lists, with and without types.
#include <fstream>
#include <regex>
#include <sstream>

#include "places.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

/// A row of the tables: "category:name", and what is said of it.
struct Documented {
  std::string category, name, meaning;
};

/// Rows are "| category:name, name, category:name | meaning |"; a name without category has that of the one before it.
std::vector<Documented> documented(const std::string& heading) {
  std::ifstream in(TOMALES_SOURCE_DIR "/docs/rib_support.md");
  std::vector<Documented> out;
  bool here = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) here = line == "## " + heading;
    const size_t bar = line.find(" | ");
    if (!here || !line.starts_with("| ") || bar == std::string::npos) continue;
    std::istringstream names(line.substr(2, bar - 2));
    std::string category;
    for (std::string word; std::getline(names, word, ',');) {
      word = std::regex_replace(word, std::regex(R"(\(.*\)|\s)"), "");
      const size_t colon = word.find(':');
      if (colon != std::string::npos) {
        category = word.substr(0, colon);
        word.erase(0, colon + 1);
      }
      if (!category.empty()) out.push_back({category, word == "*" ? "any" : word, line.substr(bar)});
    }
  }
  return out;
}

struct Value {
  std::string type, text;  ///< "int", "[0]"
};

/// Some that an option or attribute may have: numbers of all kinds, or what its row has in quotation marks.
std::vector<Value> valuesOf(const Documented& d) {
  std::string name;
  const auto standard = rib::Dictionary().find(d.name, d.category, name);
  const ValueType type = standard ? standard->type : ValueType::Float;
  std::vector<Value> out;
  if (type == ValueType::String) {
    const std::regex quoted("\"([^\"]*)\"");
    for (std::sregex_iterator it(d.meaning.begin(), d.meaning.end(), quoted), end; it != end; ++it)
      out.push_back({"string", '"' + (*it)[1].str() + '"'});
    out.push_back({"string", "\"word\""});
    return out;
  }
  const int length = standard ? standard->arrayLength : 1;
  const bool color = type == ValueType::Color;
  std::string declaration = color ? "color" : type == ValueType::Integer ? "int" : "float";
  if (length > 1) declaration += "[" + std::to_string(length) + "]";
  for (const char* number : {"0", "1", "2"}) {
    std::string list;
    for (int k = 0; k < length * (color ? 3 : 1); ++k) list += std::string(" ") + number;
    out.push_back({declaration, "[" + list + " ]"});
  }
  return out;
}

std::string scene(const std::string& request, const Documented& d, const std::string& token, const std::string& value) {
  const std::string said = request + " \"" + d.category + "\" \"" + token + "\" " + value + "\n";
  const std::string world = "LightSource \"pointlight\" 1\nSphere 1 -1 1 360";
  return request == "Option" ? said + inWorld(world) : inWorld(said + world);
}

std::string messages(const Log& log) {
  std::string out;
  for (const LogEntry& e : log.entries()) out += e.code + ": " + e.message + "\n";
  return out;
}

/// What an attribute may change that can be seen without rendering; user attributes are kept as they are given.
bool same(const Scene& a, const Scene& b) {
  Attributes left = *a.objects.at(0).attributes, right = *b.objects.at(0).attributes;
  left.user.clear();
  right.user.clear();
  return left == right && a.lights.at(0)->castsShadows == b.lights.at(0)->castsShadows;
}

TEST(Documented, TheTablesAreRead) {
  EXPECT_GT(documented("Options").size(), 20u);
  EXPECT_GT(documented("Attributes").size(), 40u);
}

TEST(Documented, EveryAttributeCountsAsMuchBareAsWithItsType) {
  const std::set<std::string> elsewhere = {"dice:roundcurve", "trimcurve:sense", "user:any",
                                           "identifier:shadinggroup"};  // not in the attributes of a sphere
  const Reading plain(inWorld("LightSource \"pointlight\" 1\nSphere 1 -1 1 360"));
  for (const Documented& d : documented("Attributes")) {
    const std::string key = d.category + ":" + d.name;
    bool counts = elsewhere.contains(key);
    for (const Value& v : valuesOf(d)) {
      const Reading bare(scene("Attribute", d, d.name, v.text));
      const Reading typed(scene("Attribute", d, v.type + " " + d.name, v.text));
      EXPECT_EQ(messages(bare.log), messages(typed.log)) << key << " " << v.text;
      EXPECT_TRUE(same(bare.scene(), typed.scene())) << key << " " << v.text;
      counts = counts || (messages(bare.log).empty() && !same(bare.scene(), plain.scene()));
    }
    EXPECT_TRUE(counts) << key << " has no effect that a user could see: is it accepted?";
  }
}

TEST(Documented, EveryOptionIsAcceptedBareAsWithItsType) {
  for (const Documented& d : documented("Options")) {
    const std::string key = d.category + ":" + d.name;
    bool accepted = false;
    for (const Value& v : valuesOf(d)) {
      const Reading bare(scene("Option", d, d.name, v.text));
      const Reading typed(scene("Option", d, v.type + " " + d.name, v.text));
      EXPECT_EQ(messages(bare.log), messages(typed.log)) << key << " " << v.text;
      accepted = accepted || messages(bare.log).empty();
    }
    EXPECT_TRUE(accepted) << key;
  }
}

// The C binding knows from nothing else how long a value is (reyes/ri.h).
TEST(Documented, EveryOptionAndAttributeHasAStandardType) {
  for (const char* heading : {"Options", "Attributes"})
    for (const Documented& d : documented(heading)) {
      std::string name;
      if (d.category != "user") {
        EXPECT_TRUE(rib::Dictionary().find(d.name, d.category, name)) << d.category << ":" << d.name;
      }
    }
}

// As scenes of BMRT and of the first PRMans have them.
TEST(Documented, OldScenesSaySomeThingsByWordsAndSomeByNumbers) {
  const auto visibility = [](const std::string& attribute) {
    const Reading r(inWorld(attribute + "\nSphere 1 -1 1 360"));
    EXPECT_EQ(messages(r.log), "") << attribute;
    return r.attributes(0);
  };
  EXPECT_FALSE(visibility(R"(Attribute "render" "casts_shadows" "none")").visibility.transmission);
  EXPECT_FALSE(visibility(R"(Attribute "visibility" "transmission" "transparent")").visibility.transmission);
  EXPECT_FALSE(visibility(R"(Attribute "visibility" "transmission" [0])").visibility.transmission);
  const Attributes opaque = visibility(R"(Attribute "visibility" "transmission" "opaque")");
  EXPECT_TRUE(opaque.visibility.transmission);
  EXPECT_EQ(opaque.transmissionHitMode, HitMode::Primitive);
  EXPECT_EQ(visibility(R"(Attribute "shade" "relativeshadingrate" 4)").shadingRate, 4);
}

}  // namespace
}  // namespace tomales
