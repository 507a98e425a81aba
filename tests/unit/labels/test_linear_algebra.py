"""Linear algebra rounds otherwise on another processor; labels and advice are the same there, bit for bit."""

import os
import signal
import subprocess
import sys
from functools import cache

import pytest

_KERNELS = ("Haswell", "Zen", "SkylakeX")
"""Of OpenBLAS beside the oldest, Prescott; one that it does not know it takes for the processor's own."""


@cache
def carried(kernel: str, without: str = "") -> str | None:
    """What comes of carrying labels over with one of the kernels; None where this processor cannot run it."""
    environment = os.environ | {"OPENBLAS_CORETYPE": kernel, "NPY_DISABLE_CPU_FEATURES": without}
    done = subprocess.run(
        [sys.executable, "-m", "tests.unit.labels.kernel_process"],
        env={name: value for name, value in environment.items() if value},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    if done.returncode == -signal.SIGILL:
        return None
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
@pytest.mark.parametrize("kernel", ["Prescott", *(pytest.param(name, marks=pytest.mark.long) for name in _KERNELS)])
def test_labels_and_advice_are_the_same_whatever_kernel_multiplies(kernel: str) -> None:
    found = carried(kernel)
    if found is None:
        pytest.skip(f"this processor cannot run {kernel}")
    assert found == carried("")


@pytest.mark.long
def test_labels_and_advice_are_the_same_without_wide_registers() -> None:
    assert carried("", "AVX2 FMA3 AVX512F AVX512_SKX X86_V3 X86_V4") == carried("")
