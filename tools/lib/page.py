"""The page of tools/watch and tools/preview: a server that answers with the page, its state and pictures, and nothing else."""

import http.server
import ipaddress
import json
import os
import re
import socket
import sys
import urllib.parse
import zlib

from messages import fail

RULES = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'; img-src blob:"


def add_options(parser, shown):
    parser.add_argument("--port", type=int, metavar="N", help="default 8080; 0 takes a free one")
    parser.add_argument("--bind", metavar="ADDRESS",
                        help=f"listen elsewhere than on this machine only; whoever reaches ADDRESS sees the {shown}")


def check_options(options):
    """Those that are not given get their defaults."""
    options.port = 8080 if options.port is None else options.port
    options.bind = "localhost" if options.bind is None else options.bind
    if not 0 <= options.port <= 65535:
        fail(f"--port {options.port}: allowed is 0 to 65535")


def is_local(address):
    """Whether only this machine can reach the address."""
    try:
        return all(ipaddress.ip_address(entry[4][0]).is_loopback for entry in socket.getaddrinfo(address, None))
    except OSError as error:
        fail(f"--bind {address}: {error.strerror}")


class Handler(http.server.BaseHTTPRequestHandler):
    """Serves the page and what the server has answers for. No file name ever comes from a request."""

    def do_GET(self):
        if self.server.is_local and not re.fullmatch(r"(localhost|127\.0\.0\.1|\[::1\])(:\d+)?", self.headers.get("Host", "")):
            return self.send_error(403, "Only reachable as localhost")  # no other site may read it under a name of its own
        url = urllib.parse.urlsplit(self.path)
        if url.path == "/":
            with open(os.path.join(os.path.dirname(os.path.realpath(__file__)), "watch.html"), "rb") as stream:
                return self.answer("text/html; charset=utf-8", stream.read())
        if url.path not in self.server.answers:
            return self.send_error(404)
        content = self.server.answers[url.path](dict(urllib.parse.parse_qsl(url.query)))
        if content is None:
            return self.send_error(404, "Nothing to show")
        if isinstance(content, bytes):
            return self.answer("image/png", content)
        return self.answer("application/json", json.dumps(content, allow_nan=False).encode())

    def answer(self, kind, content):
        """The browser asks again each time, and gets the content if it has changed."""
        tag = f'"{zlib.crc32(content):x}"'
        is_known = self.headers.get("If-None-Match") == tag
        self.send_response(304 if is_known else 200)
        for name, value in [("Content-Type", kind), ("Cache-Control", "no-cache"), ("ETag", tag),
                            ("Content-Security-Policy", RULES), ("X-Content-Type-Options", "nosniff")]:
            self.send_header(name, value)
        if not is_known:
            self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        try:
            self.wfile.write(b"" if is_known else content)
        except ConnectionError:  # the browser has gone
            pass

    def log_message(self, *_):
        pass


def serve(answers, options, shown):
    """Until Ctrl-C.
    @param answers {path: function of the query's names and values, which returns a picture (bytes), what becomes JSON, or None}"""
    local = is_local(options.bind)
    try:
        server = http.server.ThreadingHTTPServer((options.bind, options.port), Handler)
    except OSError as error:
        fail(f"--bind {options.bind} --port {options.port}: {error.strerror}; --port 0 takes a free port")
    server.answers, server.is_local = answers, local
    if not local:
        print(f"{os.path.basename(sys.argv[0])}: anyone who can reach {options.bind} can see this {shown}", file=sys.stderr)
    print(f"http://{options.bind}:{server.server_port}/  (ends with Ctrl-C)", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass
