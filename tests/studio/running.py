"""The studio's server as a process, for its tests."""
import os
import re
import signal
import subprocess
import urllib.parse


class Studio:
    """`corank studio` without a browser: its address, port and token."""

    def __init__(self, program, *arguments):
        self.process = subprocess.Popen(
            [program, "studio", "--no-browser", *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        self.address = self.process.stdout.readline().strip()
        parts = urllib.parse.urlsplit(self.address)
        self.port = parts.port
        self.token = urllib.parse.parse_qs(parts.query)["token"][0]

    def children(self):
        """The processes that compute, by their ids."""
        found = []
        for name in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                    state, parent = re.sub(r".*\) ", "", file.read()).split()[:2]
            except OSError:
                continue
            if int(parent) == self.process.pid and state != "Z":
                found.append(int(name))
        return found

    def end(self, by=signal.SIGINT):
        self.process.send_signal(by)
        status = self.process.wait(timeout=30)
        self.process.stdout.close()
        return status

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.end(signal.SIGKILL)


def resident(process):
    """Bytes of memory that a process has."""
    with open(f"/proc/{process}/statm", encoding="utf-8") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
