"""What the process imports of which local workers are copies (forks.py)."""

from distributed import versions

from . import forks, worker  # noqa: F401

versions.optional_packages = forks.compared(versions.optional_packages)
