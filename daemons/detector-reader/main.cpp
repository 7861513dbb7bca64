// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "bus/daemon.h"
#include "config/config.h"
#include "hot_pixel_lines.h"
#include "input.h"
#include "keep_out.h"
#include "nodes/detector_reader.h"
#include "refused_row_lines.h"

using namespace comptonaut;

int main(int argc, char** argv) {
  std::string what;
  const std::vector<ExtraOption> options = {
      {"--input", "tcp:PORT, pipe:PATH, file:PATH or - for standard input", &what}};
  return run_daemon(
      argc, argv, "comptonaut-detector-reader", "Makes a detector's pixel hits into events.", options,
      [&](const DaemonArguments& arguments) {
        const DetectorReaderConfig config = load_config(arguments.config, read_detector_reader_config);
        if (arguments.mav == 0) throw std::runtime_error("a detector-reader needs --mav N, the number of its MAV");
        const BatchKey first_key{.mission = config.mission, .sender = arguments.mav, .boot_epoch = wall_clock_utime()};

        EventLoop loop;
        Bus bus(arguments.lcm_url);
        DetectorReader reader(config, load_calibration(config), first_key);
        KeepOutLine keep_out;
        HotPixelLines hot_pixels;
        RefusedRowLines refused_rows(what);
        const auto publish = [&](const std::vector<EventBatch>& batches) {
          for (const EventBatch& batch : batches) bus.publish(mav_channel(arguments.mav, "EVENTS"), batch);
          keep_out.tell(reader.saturation());
          hot_pixels.tell(reader.hot_pixels().masked());
          refused_rows.tell(reader.counts().faults);
        };
        const auto input =
            open_input(what, config.input, {loop, reader, publish, [&] { return monotonic_s(arguments); }});
        publish_status(loop, bus, arguments, "detector-reader", [&] {
          return DaemonStatus{.utime = reader.utime(), .state = input->state(), .counters = reader.counters()};
        });
        loop.run();
        input->finish();
      });
}
