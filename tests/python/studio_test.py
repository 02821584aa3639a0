"""The studio from Python."""

import http.client
import os
import urllib.parse

import pytest

import corank

MODEL = """[SYSTEM VARS]
x : [-1, 1]
y : [-1, 1]
[SYSTEM EQS]
x^2 + y^2 = 1;
[INPUTS]  x
[OUTPUTS] y
"""


@pytest.fixture(name="mechanism")
def circle(tmp_path):
    path = tmp_path / "circle.cuik"
    path.write_text(MODEL)
    return corank.load(path)


def page_of(address):
    parts = urllib.parse.urlsplit(address)
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=60)
    connection.request("GET", f"{parts.path}?{parts.query}")
    with connection.getresponse() as response:
        status, text = response.status, response.read().decode()
    connection.close()
    return status, text


def test_the_studio_shows_the_mechanism_until_it_is_closed(mechanism):
    with mechanism.studio(browser=False) as studio:
        status, text = page_of(studio.address)
        assert status == 200
        assert "circle.cuik" in text
        assert "x^2 + y^2 = 1" in text
        assert studio.address.replace("&", "&amp;") in studio._repr_html_()
        process = studio._process.pid
    assert not studio.running
    assert not os.path.exists(f"/proc/{process}")
    assert repr(studio) == "<studio that has ended>"
    with pytest.raises(OSError):
        page_of(studio.address)


def test_a_port_that_is_taken_is_an_error(mechanism):
    with mechanism.studio(browser=False) as studio:
        port = urllib.parse.urlsplit(studio.address).port
        with pytest.raises(OSError, match=str(port)):
            mechanism.studio(port=port, browser=False)


def test_a_studio_that_nobody_holds_ends(mechanism):
    studio = mechanism.studio(browser=False)
    process = studio._process.pid
    del studio
    assert not os.path.exists(f"/proc/{process}")
