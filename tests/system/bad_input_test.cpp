// SPDX-License-Identifier: BSD-3-Clause
// Whatever is wrong with what a program is given: one clear line that names it, and exit code 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scratch.h"
#include "system/command.h"

using namespace std::string_literals;

namespace comptonaut {
namespace {

const std::string kBin = COMPTONAUT_BINARY_DIR "/bin/";
const std::string kConfig = COMPTONAUT_SOURCE_DIR "/config/";
const std::string kScenario = kConfig + "scenarios/werner2024-sim.yaml";
const std::string kUrl = " --lcm-url 'udpm://239.255.76.67:7671?ttl=0'";

std::string read_file(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

struct WrongCall {
  std::string name;
  std::string line;                   ///< program and arguments; SCRATCH/ is the test's folder
  std::vector<std::string> mentions;  ///< what the message must name
};

std::ostream& operator<<(std::ostream& out, const WrongCall& call) { return out << call.line; }

class BadInput : public testing::TestWithParam<WrongCall> {};

TEST_P(BadInput, GivesOneClearLineAndExitCode1) {
  scratch_file("empty", "");
  scratch_file("noise", "\x01\xff\x00{[ not: ] anything\n"s);
  scratch_file("unknown-key.yaml", read_file(kConfig + "team-link.yaml") + "surprise: 1\n");
  std::string matrix;
  for (int y = 0; y < 256; ++y) matrix += repeated("1 ", 256) + "\n";
  for (const std::string letter : {"a", "b", "c", "t"}) scratch_file(letter + ".txt", matrix);
  std::string line = GetParam().line;
  for (std::size_t at; (at = line.find("SCRATCH")) != std::string::npos;)
    line.replace(at, 7, scratch_folder().string());
  const Finished finished = run_command("timeout 20 " + kBin + line);
  EXPECT_EQ(finished.exit_code, 1) << finished.output;
  EXPECT_EQ(std::count(finished.output.begin(), finished.output.end(), '\n'), 1) << finished.output;
  for (const std::string& word : GetParam().mentions) {
    EXPECT_NE(finished.output.find(word), std::string::npos) << "'" << word << "' is not in: " << finished.output;
  }
}

const std::string kMapper = "comptonaut-mapper --mav 1 --config " + kConfig + "mapper.yaml";
const std::string kReader = "comptonaut-detector-reader --config " + kConfig + "detector-reader.yaml --mav 1";
const std::string kCampaign = "comptonaut campaign --csv SCRATCH/out.csv --scenario ";
const std::string kDetect = "comptonaut detect --calibration SCRATCH ";

INSTANTIATE_TEST_SUITE_P(
    Programs, BadInput,
    testing::Values(
        WrongCall{"NoSubcommand", "comptonaut", {"--help"}}, WrongCall{"UnknownSubcommand", "comptonaut fly", {"fly"}},
        WrongCall{"UnknownOption", kMapper + " --surprise", {"--surprise"}},
        WrongCall{"NoConfig", "comptonaut-coordinator", {"--config"}},
        WrongCall{"MissingConfig", "comptonaut-coordinator --config SCRATCH/nowhere.yaml", {"nowhere.yaml"}},
        WrongCall{"EmptyConfig", "comptonaut-team-link --config SCRATCH/empty", {"empty"}},
        WrongCall{"ConfigOfNoise", "comptonaut-mapper --config SCRATCH/noise", {"noise"}},
        WrongCall{
            "UnknownKey", "comptonaut-team-link --config SCRATCH/unknown-key.yaml", {"unknown-key.yaml", "surprise"}},
        WrongCall{"MavOutOfRange", kMapper + " --mav 999", {"--mav", "999"}},
        WrongCall{"NoBus", kMapper + " --lcm-url nonsense", {"nonsense", "udpm://"}},
        WrongCall{"GroupOfNoMulticast", kMapper + " --lcm-url 'udpm://10.0.0.1:7667'", {"10.0.0.1", "multicast"}},
        WrongCall{"BusOptionOfNoNumber", "comptonaut watch --lcm-url 'udpm://239.255.76.67:7667?ttl=abc'", {"ttl=abc"}},
        WrongCall{"UnknownBusOption", "comptonaut watch --lcm-url 'udpm://239.255.76.67:7667?tll=1'", {"tll=1"}},
        WrongCall{"ReaderWithoutInput", kReader + kUrl, {"--input"}},
        WrongCall{"ReaderOfNoFile", kReader + kUrl + " --input file:SCRATCH/nowhere.t3pa", {"nowhere.t3pa"}},
        WrongCall{"ReaderOfNoPipe", kReader + kUrl + " --input pipe:SCRATCH/nowhere", {"nowhere", "mkfifo"}},
        WrongCall{"ReaderOfAFileAsAPipe", kReader + kUrl + " --input pipe:SCRATCH/noise", {"noise", "mkfifo"}},
        WrongCall{"ReaderOfNoPort", kReader + kUrl + " --input tcp:99999", {"99999"}},
        WrongCall{"SimulatorWithoutScenario",
                  "comptonaut-simulator --config " + kConfig + "simulator.yaml" + kUrl,
                  {"--scenario"}},
        WrongCall{"CampaignOfNoScenario", kCampaign + "SCRATCH/nowhere.yaml", {"nowhere.yaml"}},
        WrongCall{"CampaignOfNoise", kCampaign + "SCRATCH/noise", {"noise"}},
        WrongCall{"CampaignOfNoSeeds", kCampaign + kScenario + " --seeds 1-3", {"--seeds", "1-3"}},
        WrongCall{"CampaignOfSeedsBackwards",
                  kCampaign + kScenario + " --seeds 3:1",
                  {"--seeds 3:1", "before it begins", "1:3"}},
        WrongCall{"CampaignOfUnknownStrategy", kCampaign + kScenario + " --strategy luck", {"--strategy", "luck"}},
        WrongCall{"CampaignOfAStrategyTwice",
                  kCampaign + kScenario + " --strategy zigzag,none,zigzag",
                  {"--strategy", "zigzag stands twice"}},
        WrongCall{"CampaignOfNoShard", kCampaign + kScenario + " --shard 4/3", {"--shard 4/3", "1..N"}},
        WrongCall{"CampaignOfAShardThatGoesNowhere", kCampaign + kScenario + " --shard 1/3", {"--shard", "--runs"}},
        WrongCall{"CampaignWithoutScenario", "comptonaut campaign", {"--scenario"}},
        WrongCall{"CampaignMergingNoise", "comptonaut campaign --csv SCRATCH/out.csv --merge SCRATCH/noise", {"noise"}},
        WrongCall{"DetectOfNoFile", kDetect + "SCRATCH/nowhere.t3pa", {"nowhere.t3pa"}},
        WrongCall{
            "DetectWithoutCalibration", "comptonaut detect SCRATCH/noise --calibration SCRATCH/nowhere", {"nowhere"}},
        WrongCall{"DetectOfUnknownNuclide", kDetect + "SCRATCH/noise --nuclide Xx-1", {"Xx-1", "Cs-137"}},
        WrongCall{
            "DetectIntoAnUnknownPicture", kDetect + "SCRATCH/noise --image SCRATCH/hits.jpg", {"hits.jpg", ".png"}},
        WrongCall{
            "SpectrumOfNoFile", "comptonaut spectrum SCRATCH/nowhere.t3pa --calibration SCRATCH", {"nowhere.t3pa"}},
        WrongCall{"DetectOverItsRecording",
                  kDetect + "SCRATCH/noise --clusters SCRATCH/../$(basename SCRATCH)/noise",
                  {"noise", "is the recording"}},
        WrongCall{"SpectrumOverItsRecording",
                  "comptonaut spectrum SCRATCH/noise --calibration SCRATCH --csv SCRATCH/noise",
                  {"noise", "is the recording"}},
        WrongCall{"SpectrumIntoNoFolder",
                  "comptonaut spectrum SCRATCH/noise --calibration SCRATCH --csv SCRATCH/nowhere/s.csv",
                  {"nowhere/s.csv"}},
        WrongCall{"ReportOfNoLog", "comptonaut report SCRATCH/nowhere.lcm", {"nowhere.lcm"}},
        WrongCall{"ReportOfNoise", "comptonaut report SCRATCH/noise --out SCRATCH/report.html", {"noise"}},
        WrongCall{"ReportOfNothing", "comptonaut report SCRATCH/empty --out SCRATCH/report.html", {"empty"}},
        WrongCall{"ResponseOfNoPhotons", "comptonaut response --out SCRATCH/t.csv --photons 0", {"photons"}},
        WrongCall{"ResponseOfAnUnknownNuclide",
                  "comptonaut response --out SCRATCH/t.csv --photons 10 --nuclide Xx-1",
                  {"--nuclide Xx-1", "Co-60"}},
        WrongCall{"ResponseOfAnotherLine",
                  "comptonaut response --out SCRATCH/t.csv --line-keV 100 --photons 10 --nuclide cs-137",
                  {"100", "661.657"}}),
    [](const auto& call) { return call.param.name; });

}  // namespace
}  // namespace comptonaut
