# SPDX-License-Identifier: Apache-2.0
"""What a worker of a Ray cluster does: some runs, if its code is that of the sweep."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
import pickle
import socket
import time
import traceback
from typing import TYPE_CHECKING

from humanoid_common.errors import UserError
from humanoid_simulation.sweep.engine import Work
from humanoid_simulation.sweep.results import RunResult
from humanoid_simulation.sweep.version import code_version

if TYPE_CHECKING:  # they are loaded once the version is known to be the same
    from humanoid_simulation.sweep.conditions import Run

_version = lru_cache(code_version)


@dataclass(frozen=True)
class Answer:
    """What has become of some runs: a result of each, or the text of an exception."""

    results: tuple[RunResult | str, ...]
    duration_s: float


@dataclass(frozen=True)
class Refusal:
    """Why a worker must not do runs of the sweep."""

    sentence: str


def packed(work: Work, runs: Sequence[Run]) -> bytes:
    """
    Pack runs for a worker, so that they are loaded only after a look at its version.

    Parameters
    ----------
    work
        Does one run.
    runs
        The runs.

    """
    return pickle.dumps((work, [*runs]))


def do_runs(version: str, package: bytes) -> Answer | Refusal:
    """
    Do runs one after the other, in a worker.

    Parameters
    ----------
    version
        Version of the code of the sweep, which the worker must have.
    package
        The work and the runs, from `packed`.

    Returns
    -------
    Answer | Refusal
        The results in the order of the runs, or why there are none.

    """
    if _version() != version:
        return Refusal(
            f'{_here()} has another version of the code, {_version()}; here it is {version}. '
            'Bring both to the same code, build it there, and give the same command again.'
        )
    begin_s = time.monotonic()
    work, runs = pickle.loads(package)  # noqa: S301 - Ray itself has sent this function so
    for run in runs:
        problem = _difference(run)
        if problem:
            return Refusal(problem)
    return Answer(tuple(_result(work, run) for run in runs), time.monotonic() - begin_s)


def _difference(run: Run) -> str:
    """Say what makes the conditions of a run other ones here; '' for nothing."""
    scene = run.conditions.scene
    try:
        if run.conditions.digest == run.key:
            return ''
    except (UserError, OSError) as error:
        return (
            f'{_here()} cannot read the scene {scene}: {error}. Put it there, too, or give its '
            'absolute path on a shared disk.'
        )
    return f'{_here()} has another scene {scene}, or another Python, than here. Copy the file.'


def _result(work: Work, run: Run) -> RunResult | str:
    """Do a run; an exception is its result, and the others are done all the same."""
    try:
        return work(run)
    except Exception:
        return traceback.format_exc().strip()


def _here() -> str:
    """Return the name of this machine, for sentences."""
    return f'The machine {socket.gethostname()} of the Ray cluster'
