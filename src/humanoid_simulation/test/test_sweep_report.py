# SPDX-License-Identifier: Apache-2.0
"""Check how runs are counted, compared and reported."""

from __future__ import annotations

import io
import math
from pathlib import Path
import sys

from humanoid_simulation.sweep.plots import falls_by, survival_over
from humanoid_simulation.sweep.progress import duration_text, print_progress, progress_line
from humanoid_simulation.sweep.report import Report
from humanoid_simulation.sweep.results import (
    Bin,
    bins_of,
    FinishedRun,
    RunResult,
    Summary,
    time_left_s,
    wilson_interval,
)
from humanoid_simulation.sweep.table import columns_of, NoParquetError, write_table
import pytest

NAME = 'friction'


def finished(key: str, value: object, outcome: str = 'stood', survived_s: float = 20.0):
    """Return a finished run."""
    result = RunResult(outcome, survived_s, 3.0, 0.2, push_x_ns=0.0, push_y_ns=8.0, push_s=2.5)
    return FinishedRun('v1', key, {'seed': 4, NAME: value}, result, '2026-01-01T00:00:00+00:00')


RUNS = [
    finished('aaaa', 0.5, 'fell', 12.0),
    finished('bbbb', 0.6, 'fell', 3.0),
    finished('cccc', 0.9),
    finished('dddd', 1.1),
]


@pytest.mark.parametrize(
    ('hits', 'trials', 'low', 'high'),
    [(0, 0, 0.0, 1.0), (0, 20, 0.0, 0.161), (5, 10, 0.237, 0.763), (20, 20, 0.839, 1.0)],
)
def test_interval(hits: int, trials: int, low: float, high: float) -> None:
    """The values of published tables of Wilson's interval."""
    assert wilson_interval(hits, trials) == pytest.approx((low, high), abs=5e-4)


def test_summary() -> None:
    """The worst run is the one that fell first; the best one stood."""
    summary = Summary.of(RUNS)
    assert (summary.finished, summary.stood, summary.fell, summary.not_stood) == (4, 2, 2, 2)
    assert summary.simulated_s == 55.0 and summary.distance_m == 12.0
    assert summary.worst is RUNS[1] and summary.best in RUNS[2:]


def test_values_are_their_own_bins() -> None:
    """Few values each have a bar, in order, also texts."""
    assert bins_of(RUNS, NAME) == [
        Bin('0.5', 1, 1), Bin('0.6', 1, 1), Bin('0.9', 1, 0), Bin('1.1', 1, 0)
    ]  # fmt: skip
    scenes = [finished('a', 'uneven', 'fell'), finished('b', 'flat'), finished('c', 'flat')]
    assert bins_of(scenes, NAME) == [Bin('flat', 2, 0), Bin('uneven', 1, 1)]


def test_many_values_share_bins() -> None:
    """Each run is in one of them, the largest value too."""
    runs = [finished(f'{n}', n / 10.0, 'fell' if n < 5 else 'stood') for n in range(21)]
    bins = bins_of(runs, NAME)
    assert [each.runs for each in bins] == [5, 5, 5, 6] and bins[0].label == '0 to 0.5'
    assert [each.fell for each in bins] == [5, 0, 0, 0]


def test_time_left() -> None:
    """It follows the speed so far, and is unknown before that."""
    assert time_left_s(0, 40, 5.0) is None
    assert time_left_s(10, 30, 60.0) == 180.0
    assert [duration_text(each) for each in (12.3, 300.0, 7200.0)] == ['12 s', '5 min', '2.0 h']


def test_progress() -> None:
    """One line has what matters."""
    line = progress_line(Summary.of(RUNS), 40, 4, 36, 20.0)
    assert line.startswith('4 of 40 | 2 fell | 3 min left | best ')
    assert line.endswith('worst bbbb fell at 3.0 s')


def test_a_log_gets_few_lines() -> None:
    """Those that stay, and others at intervals."""
    stream = io.StringIO()
    say = print_progress(stream)
    for number in range(100):
        say(f'{number} of 100', False)
    say('done', True)
    assert stream.getvalue().splitlines() == ['0 of 100', 'done']


def report(runs: list[FinishedRun]) -> str:
    """Return the page of some runs."""
    return Report('<soak>', 'v1', 40, (NAME,), runs, others=2, replay='sweep x --replay').html()


def test_failures_come_first() -> None:
    """The worst one at the top, and before runs that stood."""
    page = report(RUNS)
    order = [page.index(text) for text in ('4 of 40', 'bbbb', 'aaaa', '<svg', 'Runs that stood')]
    assert order == sorted(order)
    assert 'fell at 3.0 s' in page and '8 N s, 90°, at 2.5 s' in page
    assert '50.0%' in page and '15.0% to 85.0%' in page
    assert 'sweep x --replay KEY' in page and '2 runs of other versions' in page


def test_the_page_needs_nothing_else() -> None:
    """No script, no link, no picture from elsewhere; names are escaped."""
    page = report(RUNS)
    assert not any(
        text in page for text in ('http', '<script', '<img', '<link', '<soak>', '@import')
    )
    assert '&lt;soak&gt;' in page


def test_a_page_without_failures_or_runs() -> None:
    """It says so."""
    assert 'None: every finished run stood.' in report(RUNS[2:])
    assert '0 of 40' in report([])


def test_plots() -> None:
    """A bar and a point are where they belong: higher is more."""
    svg = falls_by(NAME, [Bin('a', 4, 4), Bin('b', 4, 0)])
    assert svg.count('class="fell"') == 2 and 'height="176.0"' in svg and 'height="0.0"' in svg
    points = survival_over(NAME, RUNS)
    assert points.count('class="fell"') == 2 and points.count('class="stood"') == 2
    assert survival_over(NAME, 1000 * RUNS).count('<circle') == 1334


def test_columns() -> None:
    """Version and key, conditions with defaults, the result."""
    columns = columns_of(RUNS)
    assert columns['key'] == ['aaaa', 'bbbb', 'cccc', 'dddd'] and columns['version'] == ['v1'] * 4
    assert columns[NAME] == [0.5, 0.6, 0.9, 1.1] and columns['latency_periods'] == [0] * 4
    assert columns['survived_s'][:2] == [12.0, 3.0]
    assert columns['commanded_forward_m_s'] == [0.0] * 4 and columns['forward_m_s'] == [0.25] * 4
    assert not [name for name in columns if name.startswith('walk.')]


def test_table(tmp_path: Path) -> None:
    """Others read the same from it; it replaces the one before."""
    parquet = pytest.importorskip('pyarrow.parquet')
    path = tmp_path / 'runs.parquet'
    write_table(path, RUNS[:1])
    write_table(path, RUNS)
    assert parquet.read_table(path).to_pydict() == columns_of(RUNS)
    assert [*tmp_path.iterdir()] == [path]


def test_without_the_library_for_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A sentence says what to do."""
    monkeypatch.setitem(sys.modules, 'pyarrow', None)
    with pytest.raises(NoParquetError, match='Install pyarrow and give the same command again'):
        write_table(tmp_path / 'runs.parquet', RUNS)
    assert [*tmp_path.iterdir()] == []


def test_tilt_is_shown_in_degrees() -> None:
    """0.2 rad are 11 degrees."""
    assert f'{math.degrees(0.2):.0f}°' == '11°' and 'largest tilt 11°' in report(RUNS)
