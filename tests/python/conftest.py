"""What several tests need: models, and one result of each of some sets."""

import os
import pathlib
import signal

import pytest

import corank

SOURCE = pathlib.Path(os.environ["CORANK_SOURCE_DIR"])

# A shell ignores Ctrl-C in what it runs in the background, and processes inherit that.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def models():
    return SOURCE / "models"


@pytest.fixture(scope="session")
def dextar(models):
    return corank.load(models / "dextar.cuik")


@pytest.fixture(scope="session")
def three_slider(models):
    return corank.load(models / "three_slider.cuik")


@pytest.fixture(scope="session")
def forward(dextar):
    return dextar.solve("forward", sigma=0.05)


@pytest.fixture(scope="session")
def points(three_slider):
    return three_slider.solve("forward")
