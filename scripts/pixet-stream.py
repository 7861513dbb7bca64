#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Hands the pixel hits of a MiniPIX TPX3 to comptonaut-detector-reader as .t3pa rows, through Pixet's Python API.

The vendor's module pypixet is in the folder of Pixet or of its API package, which this must run in. Rows are those of
Pixet's RawTpx3Pixel: matrix index, ToA, overflow, fToA, ToT. Ends when the reader goes away; let systemd or a shell
loop start it again."""
import argparse
import os
import socket
import sys


def open_output(target):
    """tcp:HOST:PORT, pipe:PATH or - for standard output, as a text file."""
    kind, _, where = target.partition(":")
    if kind == "tcp":
        host, _, port = where.rpartition(":")
        connection = socket.create_connection((host or "127.0.0.1", int(port)))
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection.makefile("w")
    if kind == "pipe":
        return open(where, "w")  # waits for the reader
    if target == "-":
        return sys.stdout
    sys.exit(f"pixet-stream: --to {target}: must be tcp:HOST:PORT, pipe:PATH or -")


class Rows:
    """Writes what is new of an acquisition."""

    def __init__(self, device, output):
        self.device, self.output, self.index = device, output, 0

    def begin(self):
        self.index = 0
        self.output.write("Index\tMatrix Index\tToA\tToT\tFToA\tOverflow\n")
        self.output.flush()

    def on_new_data(self, _event):
        pixels = self.device.lastAcqPixelsRefInc()
        try:
            for matrix_index, toa, overflow, ftoa, tot in zip(*pixels.rawPixels()):
                self.output.write(f"{self.index}\t{matrix_index}\t{toa}\t{tot}\t{ftoa}\t{overflow}\n")
                self.index += 1
            self.output.flush()
        except OSError as error:
            print(f"pixet-stream: the reader is gone: {error}", file=sys.stderr)
            os._exit(1)  # an exception would stay in Pixet's callback
        finally:
            pixels.destroy()


def register(device, event, handler):
    try:
        device.registerEvent(event, handler)
    except TypeError:
        device.registerEvent(event, 0, handler)  # older Pixet


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--to", default="tcp:127.0.0.1:7720", help="tcp:HOST:PORT, pipe:PATH or -")
    parser.add_argument("--pixet", default=".", help="folder of pypixet")
    parser.add_argument("--bias-V", type=float, default=-450.0)
    parser.add_argument("--acquisition-s", type=float, default=3600.0, help="length of one acquisition")
    parser.add_argument("--acquisitions", type=int, default=0, help="how many, 0: without end")
    arguments = parser.parse_args()
    output = open_output(arguments.to)
    os.chdir(arguments.pixet)
    sys.path.insert(0, os.getcwd())
    import pypixet
    pypixet.start()
    pixet = pypixet.pixet
    devices = pixet.devicesByType(pixet.PX_DEVTYPE_TPX3)
    if not devices:
        sys.exit("pixet-stream: no Timepix3 detector is connected, or another program has it")
    device = devices[0]
    device.loadFactoryConfig()
    device.setBias(arguments.bias_V)
    device.setOperationMode(pixet.PX_TPX3_OPM_TOATOT)
    rows = Rows(device, output)
    register(device, pixet.PX_EVENT_ACQ_NEW_DATA, rows.on_new_data)
    done = 0
    while done < arguments.acquisitions or arguments.acquisitions == 0:
        rows.begin()
        result = device.doAdvancedAcquisition(1, arguments.acquisition_s, pixet.PX_ACQTYPE_DATADRIVEN,
                                              pixet.PX_ACQMODE_NORMAL, pixet.PX_FTYPE_AUTODETECT, 0, "")
        if result != 0:
            sys.exit(f"pixet-stream: the acquisition failed ({result}): {device.lastError()}")
        done += 1
    pixet.exitPixet()


if __name__ == "__main__":
    main()
