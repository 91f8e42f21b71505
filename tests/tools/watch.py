"""tools/watch: what it shows, what it does not give away, and that the run goes first.

    watch.py PERIMORPH MPIEXEC RUNS
"""

import csv
import http.client
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

import netCDF4
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, TOOLS, InFolder, page_in_browser

import sides

RUNS = pathlib.Path(sys.argv.pop(1))
RUN = RUNS / "small_plate/out"


def functions_of_watch():
    """The tool as a module, without its server."""
    loader = importlib.machinery.SourceFileLoader("watch_tool", str(TOOLS / "watch"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Watch(InFolder):
    def setUp(self):
        super().setUp()
        self.run_folder = self.folder / "run"
        self.run_folder.mkdir()
        (self.run_folder.parent / "secret").write_text("secret")

    def watch(self, *options):
        """Starts it on a free port; returns its address."""
        server = subprocess.Popen([TOOLS / "watch", self.run_folder, "--port", "0", *options],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(server.stderr.close)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        self.server = server
        return re.match(r"http://[^/]*", server.stdout.readline()).group()

    def fill(self, run=RUN):
        shutil.copytree(run, self.run_folder, dirs_exist_ok=True)

    def read(self, url):
        with urllib.request.urlopen(url, timeout=60) as answer:
            return answer.read()

    def status(self, address, path, method="GET", **headers):
        """Of a request whose path reaches the server as it is written here."""
        connection = http.client.HTTPConnection(address.removeprefix("http://"), timeout=60)
        connection.putrequest(method, path, skip_host="Host" in headers)
        for name, value in headers.items():
            connection.putheader(name, value)
        connection.endheaders()
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        self.assertNotIn(b"secret", content)
        return answer.status

    def state(self, address, is_new=lambda state: True):
        """The state once it is new: so as not to slow a run, the same answer serves for a while."""
        until = time.monotonic() + 60
        while True:
            state = json.loads(self.read(address + "/state.json"))
            if is_new(state) or time.monotonic() > until:
                return state
            time.sleep(0.05)

    def test_waits_for_the_run_and_follows_it(self):
        address = self.watch()
        state = self.state(address)
        self.assertEqual((state["curve"], state["counts"]), (None, {}))
        self.assertEqual(self.status(address, "/picture/damage"), 404)

        for name in ["resolved.xml", "run.log", "small_plate.e"]:
            shutil.copy(RUN / name, self.run_folder)
        rows = (RUN / "history.csv").read_text().splitlines(keepends=True)
        (self.run_folder / "history.csv").write_text("".join(rows[:4]) + rows[4][:10])  # the fourth is being written
        state = self.state(address, lambda state: state["curve"])
        self.assertEqual((state["increments"], state["curve"]["increment"]), (10, [1, 2, 3]))
        self.assertEqual(self.read(address + "/picture/damage")[:8], b"\x89PNG\r\n\x1a\n")

        self.fill()
        state = self.state(address, lambda state: state["over"])
        self.assertEqual(state["curve"]["increment"][-1], 10)
        self.assertGreater(int(state["counts"]["broken bonds"]), 0)
        self.assertAlmostEqual(state["curve"]["x"][0], 0.003)  # the rate
        self.assertEqual(state["profile"][-1][0], "total")
        self.assertTrue(state["over"])

    def test_follows_a_run_whose_numbers_are_none(self):
        self.fill()
        lines = (RUN / "history.csv").read_text().splitlines()
        for row in range(4, len(lines)):
            cells = lines[row].split(",")
            for name, value in [("reaction_top_y", "nan"), ("displacement_top_y", "inf"), ("elastic_energy", "-nan")]:
                cells[lines[0].split(",").index(name)] = value
            lines[row] = ",".join(cells)
        (self.run_folder / "history.csv").write_text("\n".join([*lines, ""]))
        with netCDF4.Dataset(sorted(self.run_folder.glob("small_plate.e*"))[-1], "a") as file:
            file["vals_nod_var1"][-1, 0] = numpy.nan
        address = self.watch()
        state = self.state(address)
        self.assertEqual(state["curve"]["y"][3:], [None] * 7)
        self.assertIsInstance(state["curve"]["y"][0], float)
        self.assertTrue(any("reaction_top_y is not finite from row 4" in line for line in state["warnings"]), state["warnings"])
        self.assertEqual(self.read(address + "/picture/damage")[:8], b"\x89PNG\r\n\x1a\n")

    def test_draws_three_dimensional_bodies(self):
        self.fill(RUNS / "small_block/out")
        watch = functions_of_watch()
        file = watch.latest_step(str(self.run_folder))
        faces, elements = sides.outer_sides(file.connectivity(), 3)
        places = numpy.stack(file.coordinates(), axis=-1)
        on_box = lambda at: (at.max(axis=0) - at.min(axis=0) == 0) & numpy.isin(at[0], [[0, 16, 4, -8, 8]]).any()
        outside = [at for at in places[faces] if on_box(at).any()]
        self.assertGreaterEqual(len(outside), 2 * 64 + 4 * 16)  # of 8 x 8 x 2 cubes
        self.assertEqual(elements.max(), 127)
        self.assertEqual(self.read(self.watch() + "/picture/damage")[:4], b"\x89PNG")

    def test_a_file_that_is_just_being_made_does_not_take_the_picture_away(self):
        self.fill()
        (self.run_folder / "small_plate.e-s0099").write_bytes(b"CDF")
        self.assertEqual(self.read(self.watch() + "/picture/damage")[:4], b"\x89PNG")

    def test_gives_nothing_away_but_the_page_the_state_and_pictures(self):
        self.fill()
        address = self.watch()
        self.assertEqual(self.status(address, "/"), 200)
        for path in ["/../secret", "/%2e%2e/secret", "/picture/../../secret", "/picture/..%2f..%2fsecret", "//../secret",
                     "/run.log", "/picture/", "/picture/stress_xx", "/state.json/..", str(self.run_folder.parent / "secret")]:
            self.assertEqual(self.status(address, path), 404, path)
        self.assertEqual(self.status(address, "/", method="POST"), 501)

    def test_leaves_the_folder_as_it_is_and_holds_nothing_open(self):
        self.fill()
        before = {file: file.stat().st_mtime_ns for file in self.run_folder.iterdir()}
        address = self.watch()
        for path in ["/", "/state.json", "/picture/class", "/picture/damage"]:
            self.read(address + path)
        self.assertEqual({file: file.stat().st_mtime_ns for file in self.run_folder.iterdir()}, before)
        open_files = [os.readlink(file) for file in pathlib.Path(f"/proc/{self.server.pid}/fd").iterdir() if file.is_symlink()]
        self.assertGreater(len(open_files), 2)
        self.assertEqual([file for file in open_files if file.startswith(str(self.run_folder))], [])

    def test_has_low_priority(self):
        self.watch()
        self.assertGreaterEqual(os.getpriority(os.PRIO_PROCESS, self.server.pid), 10)

    def test_works_for_a_small_share_of_the_time_however_often_it_is_asked(self):
        watch, worked = functions_of_watch(), []

        def work(_):
            begin = time.thread_time()
            while time.thread_time() < begin + 0.02:
                pass
            worked.append(time.thread_time() - begin)
            return len(worked)

        throttled, begin = watch.Throttled(work), time.monotonic()
        while time.monotonic() < begin + 2:
            answer = throttled("run")
            self.assertEqual(answer, len(worked))  # the last one again
        self.assertGreater(len(worked), 1)
        self.assertLessEqual(sum(worked[:-1]), 1.05 * watch.SHARE * 2)  # the last one is still being made up for

    def test_a_run_that_is_watched_computes_the_same_bits(self):
        watch = functions_of_watch()
        case = self.run_folder.parent / "small_plate.xml"
        shutil.copy(RUN / "resolved.xml", case)
        shutil.copy(RUN.parent / "small_plate.geo", case.parent)
        run = subprocess.Popen([PERIMORPH, "run", case, "--output", self.run_folder, "--quiet"])
        n_drawn = 0
        while run.poll() is None:  # without rest: more than the page asks for
            watch.state_of(str(self.run_folder))
            n_drawn += watch.picture_of(str(self.run_folder), "damage") is not None
        self.assertEqual(run.returncode, 0)
        self.assertGreater(n_drawn, 0)
        self.assertEqual(*map(self.outcome, [RUN, self.run_folder]))

    def outcome(self, folder):
        """History and fields, without clocks."""
        with open(folder / "history.csv", newline="") as stream:
            rows = [{name: value for name, value in row.items() if name != "wall_seconds"} for row in csv.DictReader(stream)]
        fields = []
        for part in sorted(folder.glob("*.e*")):
            with netCDF4.Dataset(part) as file:
                fields.append({name: file[name][:].data.tobytes() for name in file.variables
                               if name not in ("qa_records", "info_records", "vals_glo_var")})
        return rows, fields

    def test_listens_on_this_machine_only_unless_told(self):
        port = int(self.watch().rpartition(":")[2])
        with open("/proc/net/tcp") as stream:
            listening = [line.split()[1] for line in stream if line.split()[3] == "0A"]
        self.assertEqual([place.partition(":")[0] for place in listening if place.endswith(f":{port:04X}")], ["0100007F"])

        self.watch("--bind", "0.0.0.0")
        self.assertIn("anyone who can reach 0.0.0.0", self.server.stderr.readline())

    def test_answers_to_the_name_of_this_machine_only(self):
        address = self.watch()
        self.assertEqual(self.status(address, "/state.json", Host="evil.example"), 403)
        self.assertEqual(self.status(address, "/state.json", Host="127.0.0.1:8080"), 200)  # a forwarded port

    def test_mistakes_are_told(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = str(taken.getsockname()[1])
            for arguments, piece in [([self.run_folder / "absent"], "no such directory"),
                                     ([self.run_folder, "--port", port], "--port 0 takes a free port"),
                                     ([self.run_folder, "--port", "99999"], "allowed is 0 to 65535")]:
                outcome = subprocess.run([TOOLS / "watch", *arguments], capture_output=True, text=True, timeout=30)
                self.assertEqual(outcome.returncode, 2)
                self.assertIn(piece, outcome.stderr)

    def test_a_browser_draws_the_curve(self):
        self.fill()
        address = self.watch()
        page = page_in_browser(address, milliseconds=3000)
        self.assertIn("Increment 10 of 10, done.", page)
        curve = re.search(r'<svg id="force".*?<polyline points="([^"]*)"', page, re.DOTALL).group(1)
        self.assertEqual(len(curve.split()), 10)
        heights = [float(point.split(",")[1]) for point in curve.split()]
        with open(RUN / "history.csv", newline="") as stream:
            forces = [float(row["reaction_top_y"]) for row in csv.DictReader(stream)]
        self.assertEqual(heights.index(min(heights)), forces.index(max(forces)))  # y points down
        self.assertIn('src="blob:http', page)
        self.assertIn("<th>total</th>", page)


if __name__ == "__main__":
    unittest.main()
