"""tools/watch: what it shows, and what it does not give away.

    watch.py PERIMORPH RUN
"""

import csv
import http.client
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
RUN = pathlib.Path(sys.argv[2]) / "out"
del sys.argv[1:]


class Watch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = pathlib.Path(folder.name) / "run"
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

    def fill(self):
        shutil.copytree(RUN, self.run_folder, dirs_exist_ok=True)

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

    def test_waits_for_the_run_and_follows_it(self):
        address = self.watch()
        state = json.loads(self.read(address + "/state.json"))
        self.assertEqual((state["curve"], state["counts"]), (None, {}))
        self.assertEqual(self.status(address, "/picture/damage"), 404)

        for name in ["resolved.xml", "run.log", "small_plate.e"]:
            shutil.copy(RUN / name, self.run_folder)
        rows = (RUN / "history.csv").read_text().splitlines(keepends=True)
        (self.run_folder / "history.csv").write_text("".join(rows[:4]) + rows[4][:10])  # the fourth is being written
        state = json.loads(self.read(address + "/state.json"))
        self.assertEqual((state["increments"], state["curve"]["increment"]), (10, [1, 2, 3]))
        self.assertEqual(self.read(address + "/picture/damage")[:8], b"\x89PNG\r\n\x1a\n")

        self.fill()
        state = json.loads(self.read(address + "/state.json"))
        self.assertEqual(state["curve"]["increment"][-1], 10)
        self.assertGreater(int(state["counts"]["broken bonds"]), 0)
        self.assertAlmostEqual(state["curve"]["x"][0], 0.003)  # the rate
        self.assertEqual(state["profile"][-1][0], "total")
        self.assertTrue(state["over"])

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

    def test_leaves_the_folder_as_it_is(self):
        self.fill()
        before = {file: file.stat().st_mtime_ns for file in self.run_folder.iterdir()}
        address = self.watch()
        for path in ["/", "/state.json", "/picture/class"]:
            self.read(address + path)
        self.assertEqual({file: file.stat().st_mtime_ns for file in self.run_folder.iterdir()}, before)

    def test_listens_on_this_machine_only_unless_told(self):
        port = int(self.watch().rpartition(":")[2])
        with open("/proc/net/tcp") as stream:
            listening = [line.split()[1] for line in stream if line.split()[3] == "0A"]
        self.assertEqual([place.partition(":")[0] for place in listening if place.endswith(f":{port:04X}")], ["0100007F"])

        self.watch("--bind", "0.0.0.0")
        self.assertIn("everybody who reaches 0.0.0.0", self.server.stderr.readline())

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
                told = subprocess.run([TOOLS / "watch", *arguments], capture_output=True, text=True, timeout=30)
                self.assertEqual(told.returncode, 2)
                self.assertIn(piece, told.stderr)

    @unittest.skipUnless(shutil.which("chromium"), "needs chromium")
    def test_a_browser_draws_the_curve(self):
        self.fill()
        address = self.watch()
        with tempfile.TemporaryDirectory() as profile:
            page = subprocess.run(
                ["timeout", "--kill-after=5", "50", "chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
                 "--virtual-time-budget=3000", "--dump-dom", address],
                capture_output=True, text=True, timeout=60).stdout
        self.assertIn("Increment 10 of 10, done.", page)
        curve = re.search(r'<svg id="force".*?<polyline points="([^"]*)"', page, re.DOTALL).group(1)
        self.assertEqual(len(curve.split()), 10)
        heights = [float(point.split(",")[1]) for point in curve.split()]
        with open(RUN / "history.csv", newline="") as stream:
            forces = [float(row["reaction_top_y"]) for row in csv.DictReader(stream)]
        self.assertEqual(heights.index(min(heights)), forces.index(max(forces)))  # y points down
        self.assertIn('src="picture/damage', page)
        self.assertIn("<th>total</th>", page)


if __name__ == "__main__":
    unittest.main()
