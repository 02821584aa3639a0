"""The studio's server, by raw sockets: python3 server_test.py PROGRAM MODELS."""
import http.client
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import unittest

import running

PROGRAM, MODELS = sys.argv[1], pathlib.Path(sys.argv[2])
SLIDER = (MODELS / "three_slider.cuik").read_text(encoding="utf-8")
PATIENCE = 60  # seconds until a test gives up


class Window:
    """What a page does: listens to events, and asks."""

    def __init__(self, studio, name):
        self.studio, self.name = studio, name
        self.connection = http.client.HTTPConnection("127.0.0.1", studio.port, timeout=PATIENCE)
        self.connection.request("GET", f"/events?token={studio.token}&client={name}")
        self.response = self.connection.getresponse()

    def ask(self, number, text=SLIDER, sets=("cspace", "forward"), **more):
        request = {"number": number, "want": "picture", "file": "a.cuik", "text": text, "sets": list(sets), **more}
        return self.post(number, json.dumps(request))

    def post(self, number, body, headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.studio.port, timeout=PATIENCE)
        connection.request("POST", f"/ask?token={self.studio.token}&client={self.name}&number={number}", body, headers or {})
        with connection.getresponse() as response:
            status = response.status
        connection.close()
        return status

    def event(self):
        while True:
            line = self.response.readline()
            if not line:
                raise EOFError("the stream ended")
            if line.startswith(b"data: "):
                return json.loads(line[6:])

    def until(self, kind, number=None):
        while True:
            event = self.event()
            if event["event"] == kind and number in (None, event.get("number")):
                return event

    def close(self):
        self.response.close()
        self.connection.close()


class Server(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.studio = running.Studio(PROGRAM, str(MODELS / "three_slider.cuik"))

    @classmethod
    def tearDownClass(cls):
        cls.studio.__exit__()

    def get(self, target, method="GET", headers=None, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.studio.port, timeout=PATIENCE)
        connection.request(method, target, body, headers or {})
        response = connection.getresponse()
        result = response.status, response.read().decode(), dict(response.getheaders())
        connection.close()
        return result

    def wait_for_children(self, count):
        """Processes end a moment after their windows: looks until there are that many."""
        for _ in range(2000):
            if len(self.studio.children()) == count:
                return
            self.get("/favicon.ico")
        self.fail(f"{len(self.studio.children())} processes, expected {count}")

    def test_listens_on_this_machine_only(self):
        with open("/proc/net/tcp", encoding="utf-8") as file:
            listening = [line.split()[1] for line in file.readlines()[1:] if line.split()[3] == "0A"]
        own = [place for place in listening if place.endswith(f":{self.studio.port:04X}")]
        self.assertEqual(own, [f"0100007F:{self.studio.port:04X}"])

    def test_shows_the_page_to_who_has_the_token_only(self):
        token = self.studio.token
        status, page, headers = self.get(f"/?token={token}")
        self.assertEqual(status, 200)
        self.assertIn("three_slider.cuik", page)
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        for wrong in ("", "?token=", f"?token={token[:-1]}", f"?token={token}0", "?token=" + "0" * 32, f"?Token={token}"):
            status, text, _ = self.get("/" + wrong)
            self.assertEqual(status, 403, wrong)
            self.assertNotIn("three_slider", text)
        for target in ("/events", "/ask", "/nowhere", "/../../etc/passwd"):
            self.assertEqual(self.get(target + "?client=a")[0], 403)
        self.assertEqual(self.get(f"/../../etc/passwd?token={token}")[0], 404)

    def test_refuses_other_hosts_origins_and_sites(self):
        page, port = f"/?token={self.studio.token}", self.studio.port
        for headers, expected in (
            ({"Host": f"127.0.0.1:{port}", "Origin": f"http://127.0.0.1:{port}"}, 200),
            ({"Host": f"localhost:{port}", "Origin": f"http://localhost:{port}"}, 200),
            ({"Host": "evil.example"}, 403),
            ({"Host": f"evil.example:{port}"}, 403),
            ({"Host": f"127.0.0.1:{port + 1}"}, 403),
            ({"Host": f"127.0.0.1:{port}", "Origin": "http://evil.example"}, 403),
            ({"Host": f"127.0.0.1:{port}", "Origin": "null"}, 403),
            ({"Host": f"127.0.0.1:{port}", "Origin": f"https://127.0.0.1:{port}"}, 403),
            ({"Host": f"127.0.0.1:{port}", "Origin": f"http://127.0.0.1:{port + 1}"}, 403),
        ):
            self.assertEqual(self.get(page, headers=headers)[0], expected, headers)
        ask = f"/ask?token={self.studio.token}&client=a&number=1"
        self.assertEqual(self.get(ask, "POST", {"Sec-Fetch-Site": "cross-site"}, "{}")[0], 403)

    def test_answers_what_a_window_asks_and_no_other(self):
        first, second = Window(self.studio, "first"), Window(self.studio, "second")
        self.assertEqual(first.response.getheader("Content-Type"), "text/event-stream")
        self.assertEqual(first.ask(1), 204)
        self.assertEqual(second.ask(5, sets=["inverse"]), 204)
        self.assertEqual([s["name"] for s in second.until("picture")["model"]["sets"]], ["inverse"])
        self.assertTrue(first.until("done")["complete"])
        self.assertEqual(second.until("done")["number"], 5)
        first.close()
        second.close()
        self.wait_for_children(0)

    def test_a_new_request_ends_the_one_before(self):
        window = Window(self.studio, "anew")
        slow = (MODELS / "platforms" / "delta.cuik").read_text(encoding="utf-8")
        window.ask(1, slow)
        window.until("begun", 1)
        for number in range(2, 30):
            window.ask(number, slow)
        window.ask(30)
        self.assertTrue(window.until("done")["complete"])
        self.assertEqual(len(self.studio.children()), 1)
        window.close()
        self.wait_for_children(0)

    def test_a_process_that_dies_is_made_anew(self):
        window = Window(self.studio, "dies")
        window.ask(1, (MODELS / "platforms" / "delta.cuik").read_text(encoding="utf-8"))
        window.until("model", 1)
        os.kill(self.studio.children()[0], signal.SIGKILL)
        self.assertIn("unexpectedly", window.until("error", 1)["message"])
        window.ask(2)
        self.assertTrue(window.until("done", 2)["complete"])
        window.close()
        self.wait_for_children(0)

    def test_more_windows_than_a_browser_can_show_are_refused(self):
        windows = [Window(self.studio, f"w{k}") for k in range(6)]
        self.assertEqual([window.response.status for window in windows], [200] * 5 + [503])
        for window in windows:
            window.close()
        self.wait_for_children(0)

    def test_what_is_no_request_is_said_and_does_no_harm(self):
        window = Window(self.studio, "bad")
        generator = random.Random(40)
        for number in range(1, 60):
            size = generator.randrange(200)
            body = "".join(generator.choice('{}[]":,0123456789enumbrtxs\\\n ') for _ in range(size))
            self.assertEqual(window.post(number, body), 204)
        self.assertEqual(window.event()["event"], "bad")
        window.ask(100)
        self.assertTrue(window.until("done", 100)["complete"])
        self.assertEqual(window.post(101, b"", {"Content-Length": str(4 << 20)}), 413)
        for wrong in ("", "x", "-1", "1" * 30):
            self.assertEqual(window.post(wrong, "{}"), 400)
        window.close()
        self.wait_for_children(0)

    def test_a_thousand_malformed_requests_do_no_harm(self):
        good = (
            f"POST /ask?token={self.studio.token}&client=abc&number=1 HTTP/1.1\r\nHost: 127.0.0.1:{self.studio.port}\r\n"
            f'Content-Length: 12\r\nOrigin: http://127.0.0.1:{self.studio.port}\r\n\r\n{{"number":1}}'
        ).encode()
        generator = random.Random(1)
        for k in range(1000):
            text = bytearray(good)
            kind = k % 4
            if kind == 0:  # other bytes
                for _ in range(generator.randrange(1, 12)):
                    text[generator.randrange(len(text))] = generator.randrange(256)
            elif kind == 1:  # cut short
                del text[generator.randrange(len(text)) :]
            elif kind == 2:  # repeated parts
                a, b = sorted(generator.randrange(len(text)) for _ in range(2))
                text[b:b] = text[a:b] * generator.randrange(1, 40)
            else:  # noise
                text = bytearray(generator.randbytes(generator.randrange(2000)))
            with socket.create_connection(("127.0.0.1", self.studio.port), timeout=PATIENCE) as connection:
                try:
                    connection.sendall(text)
                    connection.shutdown(socket.SHUT_WR)
                    answer = connection.recv(1 << 16)
                except OSError:  # it may close before it has read all
                    answer = b""
            self.assertTrue(answer == b"" or answer.startswith(b"HTTP/1.1 "), answer[:100])
            self.assertNotIn(b"HTTP/1.1 200", answer)
        self.assertEqual(self.get(f"/?token={self.studio.token}")[0], 200)
        self.wait_for_children(0)


class Program(unittest.TestCase):
    def test_ctrl_c_ends_it_with_all_that_it_runs(self):
        for by in (signal.SIGINT, signal.SIGTERM):
            with running.Studio(PROGRAM) as studio:
                window = Window(studio, "a")
                window.ask(1, (MODELS / "platforms" / "delta.cuik").read_text(encoding="utf-8"))
                window.until("model")
                children = studio.children()
                self.assertEqual(len(children), 1)
                self.assertEqual(studio.end(by), 0)
                self.assertFalse(os.path.exists(f"/proc/{children[0]}"))
                window.close()

    def test_its_processes_end_where_it_is_killed(self):
        with running.Studio(PROGRAM) as studio:
            window = Window(studio, "a")
            window.ask(1, (MODELS / "platforms" / "delta.cuik").read_text(encoding="utf-8"))
            window.until("model")
            child = studio.children()[0]
            studio.end(signal.SIGKILL)
            while os.path.exists(f"/proc/{child}"):
                with open(f"/proc/{child}/stat", encoding="utf-8", errors="replace") as file:
                    if file.read().rpartition(")")[2].split()[0] == "Z":
                        break
            window.close()

    def test_takes_a_port_and_says_where_it_is_taken(self):
        with running.Studio(PROGRAM) as studio:
            second = subprocess.run(
                [PROGRAM, "studio", "--no-browser", "--port", str(studio.port)], capture_output=True, text=True, check=False
            )
            self.assertEqual(second.returncode, 1)
            self.assertIn(str(studio.port), second.stderr)
            self.assertEqual(second.stdout, "")

    def test_every_run_has_a_token_of_its_own(self):
        tokens = set()
        for _ in range(3):
            with running.Studio(PROGRAM) as studio:
                tokens.add(studio.token)
        self.assertEqual(len(tokens), 3)
        self.assertTrue(all(len(token) == 32 for token in tokens))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
