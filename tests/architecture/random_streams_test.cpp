// Streams of random numbers are named, and a name is part of the seed: whoever renames one changes every game. Their
// names and first draws are pinned here.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "base/random.hpp"
#include "tree.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// Name as the source writes it ({} and the end of a prefix stand for what is filled in) -> first draw of seed 1.
const std::map<std::string, std::uint64_t> kFirstDraws = {
    {"anchor/", 13176875946492852114U},
    {"calibration of ", 630423628591431636U},
    {"calibration of round {}", 3784075993506983070U},
    {"clock/{}/{}", 3614438228195398888U},
    {"dense sampling of ", 15782769383603131073U},
    {"diagnosis/fractures {}", 1190706786887560298U},
    {"diagnosis/kept emulator", 15625020678285821195U},
    {"diagnosis/runs", 14538325407690868142U},
    {"explore/barred", 12786851038266922844U},
    {"explore/cube models", 16113961047525853125U},
    {"explore/dgemo", 12252799894720483047U},
    {"explore/egbo", 10851495055247331733U},
    {"explore/morbo", 15865780673835418172U},
    {"explore/nehvi", 5884542198328993698U},
    {"explore/random", 16030807914340714355U},
    {"explore/restart {}", 6473518454692981806U},
    {"explore/start", 7452020567112302841U},
    {"explore/tsemo", 8357831304277106758U},
    {"families/dense sampling", 1083884379677338645U},
    {"families/evidence", 6123146135363918035U},
    {"faults/", 13201436478966451412U},
    {"gain/folds", 11204272626700558866U},
    {"gain/interval", 14940613204199090927U},
    {"gamut search {}", 2628046162092627341U},
    {"growth in a round", 14243183915782408401U},
    {"growth in the next round", 420643055374080181U},
    {"hold-out", 12301178871895818373U},
    {"hypervolume bootstrap", 15143888943239658097U},
    {"kernel/", 6022292932074911506U},
    {"mixture of ", 6639545961682335916U},
    {"nearby", 12028333496241502629U},
    {"optimize/cma-es", 10713043348104623855U},
    {"optimize/kernel", 8382513058645745129U},
    {"optimize/random", 13547903028715155376U},
    {"optimize/sobol", 10723616310399554125U},
    {"optimize/space-filling", 9927620754339669771U},
    {"outsider/", 6422776432197731627U},
    {"patterns to come", 5542844590660947729U},
    {"print order", 18004633763545147775U},
    {"print/{}/{}", 13685545547872858727U},
    {"redraw {}", 8551103175985092839U},
    {"rival/", 11579641789542395294U},
    {"search {}", 13318928028725689828U},
    {"search/", 12572077440216843079U},
    {"slope/", 13259846407278886486U},
    {"specimen/{}/{}", 10734041044105544372U},
    {"stratified random patterns", 12030668745400846242U},
    {"strength of {}/{}/{}", 7855580923050014907U},
    {"strength_scatter", 1191495373525714289U},
    {"surrogate/kernel", 11879602038280261339U},
    {"sysid/batch", 18172197041893375533U},
    {"sysid/first", 5481801407623199485U},
    {"sysid/plausible", 11812596528671965977U},
    {"sysid/sampler", 12976734404777795310U},
    {"sysid/walkers", 16759426285845376275U},
    {"table trends", 4303189804549083874U},
    {"truth/", 229579106783781658U},
    {"truth/coupons/", 7727934983312255326U},
    {"truth/effect/", 10170139508479994969U},
    {"truth/effects", 5916075799099307628U},
    {"voxels/{}/{}/{}", 60081016352054761U},
};

/// The first piece of text of every RandomStream that is made below lib and nodes.
std::set<std::string> names_in_sources() {
  static const std::regex kStream(R"re((?:RandomStream(?:\s+\w+)?|random_|numbered)\([^;{}]*?"([^"]+)")re");
  std::set<std::string> names;
  for (const char* folder : {"lib", "nodes"}) {
    for (const fs::path& file : sources_below(folder)) {
      if (file == "lib/base/random.cpp") continue;
      const std::string text = text_of(file);
      for (auto found = std::sregex_iterator(text.begin(), text.end(), kStream); found != std::sregex_iterator();
           ++found)
        names.insert((*found)[1]);
    }
  }
  return names;
}

TEST(RandomStreams, HaveTheNamesThatTheyAlwaysHad) {
  for (const std::string& name : names_in_sources()) {
    EXPECT_TRUE(kFirstDraws.contains(name))
        << "a new stream: add it, {\"" << name << "\", " << RandomStream(1, name).bits() << "U}";
  }
  const std::set<std::string> names = names_in_sources();
  for (const auto& [name, draw] : kFirstDraws) EXPECT_TRUE(names.contains(name)) << "renamed or gone: " << name;
}

TEST(RandomStreams, FirstDrawsArePinned) {
  for (const auto& [name, draw] : kFirstDraws) EXPECT_EQ(RandomStream(1, name).bits(), draw) << name;
}

}  // namespace
}  // namespace nacre
