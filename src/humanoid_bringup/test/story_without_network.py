# SPDX-License-Identifier: Apache-2.0
"""The full system without any network, in a namespace that has none: `make stories`."""

from __future__ import annotations

from pathlib import Path
import shutil
import subprocess
import sys

import pytest

STORY = Path(__file__).parent / 'test_system_commands.py'
SEPARATE = ('unshare', '--net', 'sh', '-c')
ALONE = 'ip link set lo up && test "$(ip -o link | wc -l)" = 1 && exec "$@"'

pytestmark = pytest.mark.timeout(1200)


def refusal() -> str:
    """Return why there is no namespace to be had; empty if there is."""
    missing = [name for name in ('unshare', 'ip', 'sh') if shutil.which(name) is None]
    if missing:
        return f'It needs the programs {", ".join(missing)}: install util-linux and iproute2.'
    tried = subprocess.run([*SEPARATE, ALONE, 'sh', 'true'], capture_output=True, text=True)
    return f'{tried.stderr.strip()}; it needs root.' if tried.returncode else ''


def test_it_works_without_network() -> None:
    """All starts and does the story, with no interface but the one of this machine to itself."""
    if reason := refusal():
        pytest.skip(f'This machine does not let a test have a network of its own: {reason}')
    pytest_command = [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', str(STORY)]
    ended = subprocess.run(
        [*SEPARATE, ALONE, 'sh', *pytest_command], capture_output=True, text=True, timeout=1100
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr
