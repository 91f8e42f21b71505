"""Power cuts: a disk that loses, in the middle of a run, all that had not been brought to it. --restart goes on, to the bits of a run
that nothing disturbs. Needs root and a loop device.

    power_cut.py PERIMORPH MPIEXEC

PERIMORPH_POWER_CUTS is how often; 4 if it is not set. Exit status 77 if that cannot be done here.
"""

import fcntl
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import EVERY, INCREMENTS, settings
from whole_run import WholeRun

CUTS = int(os.environ.get("PERIMORPH_POWER_CUTS", 4))
SHUTDOWN = 2 << 30 | struct.calcsize("I") << 16 | ord("X") << 8 | 125  # ioctl_ext4(2): EXT4_IOC_SHUTDOWN
WITHOUT_ITS_JOURNAL = 2
CANNOT = 77


class Disk:
    """An ext4 file system in a file."""

    def __init__(self, folder):
        self.image, self.path = folder / "disk", folder / "mounted"
        self.path.mkdir()
        with open(self.image, "wb") as file:
            file.truncate(64 << 20)
        self.call("mkfs.ext4", "-q", "-F", self.image)
        self.mount()

    @staticmethod
    def call(*command):
        subprocess.run(command, check=True, capture_output=True, text=True)

    def mount(self):
        self.call("mount", "-o", "loop", self.image, self.path)

    def cut(self):
        """What has not reached the disk so far never does."""
        descriptor = os.open(self.path, os.O_RDONLY)
        fcntl.ioctl(descriptor, SHUTDOWN, struct.pack("I", WITHOUT_ITS_JOURNAL))
        os.close(descriptor)

    def unmount(self):
        end = time.monotonic() + 20  # ranks that have lost their disk need a moment to go
        while subprocess.run(["umount", self.path], capture_output=True).returncode != 0:
            if time.monotonic() > end:
                raise OSError(f"{self.path} is in use")
            time.sleep(0.05)


def reason_why_not():
    if os.geteuid() != 0:
        return "only root can make a disk"
    folder = pathlib.Path(subprocess.run(["mktemp", "-d"], capture_output=True, text=True).stdout.strip())
    try:
        Disk(folder).unmount()
    except (OSError, subprocess.CalledProcessError) as error:
        return f"no loop device: {error}: {getattr(error, 'stderr', '')}"
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return ""


class PowerCut(WholeRun):
    def disk(self, name):
        folder = self.folder / name
        folder.mkdir()
        disk = Disk(folder)
        self.addCleanup(disk.unmount)
        self.output = disk.path / "out"
        return disk

    def n_rows(self):
        try:
            return len((self.output / "history.csv").read_bytes().splitlines()) - 1
        except OSError:
            return 0

    def cut_during(self, disk, *options, after, moment, ranks):
        run = self.start(*EVERY, *options, ranks=ranks)
        end = time.monotonic() + 60
        while self.n_rows() < after and run.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        time.sleep(moment)
        disk.cut()
        run.kill()
        run.wait()
        disk.unmount()
        disk.mount()

    def test_a_run_goes_on_after_power_cuts(self):
        seed = random.randrange(10**6)
        chance = random.Random(seed)
        spread = settings("Output/Spread Files=true")
        for cut in range(CUTS):
            ranks, options = (2, spread) if cut % 4 == 3 else (1, [])
            with self.subTest(cut=cut, seed=seed):
                if cut in (0, 3):
                    shutil.rmtree(self.folder / "whole", ignore_errors=True)
                expected = self.whole(*options, ranks=ranks)
                disk = self.disk(f"cut-{cut}")
                self.cut_during(disk, *options, after=chance.randint(0, INCREMENTS - 1), moment=chance.uniform(0, 0.03), ranks=ranks)
                if cut % 2:  # and once more while it goes on
                    self.cut_during(disk, *options, "--restart", after=self.n_rows() + 1, moment=chance.uniform(0, 0.03), ranks=ranks)
                run = self.run_case("--quiet", *EVERY, *options, "--restart", ranks=ranks)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(self.difference(self.everything(), expected), "")

    def test_over_the_results_of_an_older_run(self):
        chance = random.Random()
        expected = self.whole()
        disk = self.disk("over")
        for _ in range(max(2, CUTS // 4)):
            self.run_until(INCREMENTS, *EVERY)
            subprocess.run(["sync"], check=True)
            self.cut_during(disk, after=0, moment=chance.uniform(0, 0.5), ranks=1)
            run = self.run_case("--quiet", *EVERY, "--restart")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(self.difference(self.everything(), expected), "")


if __name__ == "__main__":
    why_not = reason_why_not()
    if why_not:
        print("skipped:", why_not)
        sys.exit(CANNOT)
    unittest.main()
