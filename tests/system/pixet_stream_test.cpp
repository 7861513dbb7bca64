// SPDX-License-Identifier: BSD-3-Clause
// scripts/pixet-stream.py between a stand-in for the vendor's module and the real detector-reader. It shows that the
// rows are right, not that Pixet is as the stand-in: that takes a MiniPIX.
#include "system/command.h"
#include "system/live_reader.h"

namespace comptonaut {
namespace {

/// Two acquisitions' worth of data driven pixels, handed over in blocks of ten: one hit a millisecond, each in
/// another pixel, ToT 150.
constexpr const char* kModule = R"(
class Pixels:
    def __init__(self, block):
        self.block = block
    def rawPixels(self):
        times = [40000 * (10 * self.block + i + 1) for i in range(10)]
        pixels = [257 * (10 + 10 * self.block + i) for i in range(10)]
        return [pixels, times, [0] * 10, [5] * 10, [150] * 10]
    def destroy(self):
        pass

class Device:
    def loadFactoryConfig(self): return 0
    def setBias(self, volts): assert volts == -450.0
    def setOperationMode(self, mode): assert mode == "toatot"
    def registerEvent(self, event, handler): self.handler = handler
    def lastAcqPixelsRefInc(self): return Pixels(self.block)
    def doAdvancedAcquisition(self, count, time_s, kind, mode, file_type, flags, file_name):
        assert kind == "data driven" and file_name == ""
        for self.block in range(20):
            self.handler(None)
        return 0

class Pixet:
    PX_DEVTYPE_TPX3, PX_TPX3_OPM_TOATOT, PX_EVENT_ACQ_NEW_DATA = 4, "toatot", "new data"
    PX_ACQTYPE_DATADRIVEN, PX_ACQMODE_NORMAL, PX_FTYPE_AUTODETECT = "data driven", 0, 0
    def devicesByType(self, kind): return [Device()]
    def exitPixet(self): pass

pixet = Pixet()
def start(): return 0
)";

TEST(PixetStream, TheRowsOfTheVendorsModuleBecomeEvents) {
  const auto module = scratch_file("pypixet.py", kModule);
  const int port = free_udp_port();
  LiveReader reader("tcp:" + std::to_string(port));
  ASSERT_TRUE(reader.wait([&] { return reader.state == "waits for a connection"; }));
  const Finished finished = run_command(
      COMPTONAUT_SOURCE_DIR "/scripts/pixet-stream.py --acquisitions 2 --to tcp:127.0.0.1:" + std::to_string(port) +
      " --pixet " + module.parent_path().string());
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  ASSERT_TRUE(reader.wait([&] { return reader.singles() == 400; })) << reader.singles();
  ASSERT_TRUE(reader.wait([&] { return reader.counters["epochs"] == 2; }));
  EXPECT_EQ(reader.counters["rows"], 400);
}

TEST(PixetStream, SaysWhatIsWrong) {
  const Finished finished = run_command(COMPTONAUT_SOURCE_DIR "/scripts/pixet-stream.py --to nowhere");
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_NE(finished.output.find("--to nowhere: must be"), std::string::npos) << finished.output;
}

}  // namespace
}  // namespace comptonaut
