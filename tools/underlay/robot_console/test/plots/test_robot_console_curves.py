# SPDX-License-Identifier: Apache-2.0
"""What is kept of values, what is drawn, and what is saved."""

from __future__ import annotations

import math

import numpy as np
from plot_messages import schema, state
import pytest
from robot_console.panels.plots_panel import csv_text
from robot_console.plots.plot_board import PlotBoard
from robot_console.plots.plot_chart import legend_html
from robot_console.plots.series import (
    effort,
    imu,
    MAX_PRESET_JOINTS,
    parse_series,
    PathError,
    tracking_error,
)
from robot_console.plots.traces import MAX_CAPACITY, slice_times, SLICES, thinned, Trace

WINDOW_S = 10.0
NAN = math.nan


def trace(times: list[float], values: list[float], keep_s: float = 1000.0) -> Trace:
    """Return a trace with values."""
    trace = Trace(keep_s)
    for time_s, value in zip(times, values):
        trace.add(time_s, value)
    return trace


def drawn(times: list[float], values: list[float], now_s: float = WINDOW_S) -> np.ndarray:
    """Return what is drawn of the last ten seconds."""
    return thinned(np.array(times), np.array(values), now_s, WINDOW_S)


def at(curve: np.ndarray, second: float) -> float:
    """Return the first that is drawn of a slice, of a window whose last slice begins at 10 s."""
    return float(curve[2 * (math.floor(second / WINDOW_S * SLICES) - 1)])


def test_trace_keeps_what_is_wanted() -> None:
    """Values from a time on are there with the one before; much older ones are forgotten."""
    kept = trace([float(index) for index in range(2000)], [float(x) for x in range(2000)], 100.0)
    times, values = kept.since(1995.5)
    assert times.tolist() == values.tolist() == [1995.0, 1996.0, 1997.0, 1998.0, 1999.0]
    assert kept.since(0.0)[0][0] > 1000.0
    assert kept.newest == 1999.0


def test_trace_is_limited() -> None:
    """However many values come, and however long they are wanted, the newest are kept."""
    kept = Trace(1e9)
    for index in range(MAX_CAPACITY + 5):
        kept.add(float(index), 1.0)
    times, _ = kept.since(0.0)
    assert MAX_CAPACITY // 2 <= len(times) <= MAX_CAPACITY
    assert times[-1] == MAX_CAPACITY + 4


def test_trace_when_time_jumps_back() -> None:
    """Messages out of order do no harm; when a clock was set back, all begins anew."""
    assert trace([5.0, 4.9, 6.0], [1.0, 2.0, 3.0]).since(0.0)[0].tolist() == [5.0, 5.0, 6.0]
    assert trace([5000.0, 1.0], [1.0, 2.0]).since(0.0)[1].tolist() == [2.0]


def test_a_line_between_values() -> None:
    """Between values the curve goes straight; before and after them there is none."""
    curve = drawn([2.0, 2.9], [0.0, 9.0])
    assert at(curve, 2.45) == pytest.approx(4.5, abs=0.3)
    assert np.isnan(at(curve, 1.9)) and np.isnan(at(curve, 3.0))
    assert len(curve) == len(slice_times(WINDOW_S)) == 2 * SLICES <= 2000


def test_peaks_stay() -> None:
    """A single peak among many thousand values is drawn with its full height."""
    times = np.linspace(0.0, 9.99, 50000)
    values = np.zeros(50000)
    values[31234], values[41234] = 7.0, -5.0
    curve = thinned(times, values, WINDOW_S, WINDOW_S)
    assert np.nanmax(curve) == 7.0 and np.nanmin(curve) == -5.0
    place = int(np.nanargmax(curve)) // 2
    assert place == math.floor(times[31234] / WINDOW_S * SLICES) - 1


def test_gaps() -> None:
    """What is no number, and a time without values, are gaps; a slow topic has none."""
    ticks = [index / 10 for index in range(100)]
    not_numbers = [NAN if 3.0 < tick < 4.0 else 1.0 for tick in ticks]
    curve = drawn(ticks, not_numbers)
    assert np.isnan(at(curve, 3.5)) and at(curve, 2.9) == at(curve, 4.2) == 1.0
    quiet = [tick for tick in ticks if not 5.0 < tick < 8.0]
    curve = drawn(quiet, [1.0] * len(quiet))
    assert np.isnan(at(curve, 6.5)) and at(curve, 4.5) == at(curve, 8.5) == 1.0
    slow = drawn([0.5, 2.5, 4.5, 6.5, 8.5], [1.0] * 5)
    assert not np.isnan(slow[48:672]).any()


@pytest.mark.parametrize('values', [[], [NAN, NAN], [math.inf, -math.inf]])
def test_nothing_to_draw(values: list[float]) -> None:
    """Without numbers there is no curve, and no failure."""
    assert np.isnan(drawn([1.0, 2.0][: len(values)], values)).all()


def test_curves_do_not_tremble() -> None:
    """While time goes on, the same values are drawn, only farther left."""
    times = np.arange(0.0, 40.0, 0.001)
    values = np.sin(50.0 * times)
    step_s = WINDOW_S / SLICES
    before = thinned(times, values, 20.0 + 0.2 * step_s, WINDOW_S)
    after = thinned(times, values, 20.0 + 5.2 * step_s, WINDOW_S)
    assert before[10:].tolist() == after[:-10].tolist()


def board(*series: str) -> PlotBoard:
    """Return a board whose topics have a type."""
    board = PlotBoard(WINDOW_S)
    board.replace(map(parse_series, series))
    for topic in board.topics:
        board.find_type(topic, 'a/State', schema)
    return board


def test_board() -> None:
    """Messages become curves; a difference is of what came last on both topics."""
    plots = board('js.position[knee]', 'jc.position[knee] - js.position[knee]')
    plots.take('js', state(knee=1.0), 1.0)
    plots.take('jc', state(knee=1.5), 1.1)
    plots.take('js', state(knee=2.0), 1.2)
    plots.take('other', state(knee=9.0), 1.3)
    one, two = plots.columns(2.0).values()
    assert one[1].tolist() == [1.0, 2.0]
    assert [each.tolist() for each in two] == [[1.1, 1.2], [0.5, -0.5]]
    assert plots.topics == {'js', 'jc'}


def test_a_difference_needs_both() -> None:
    """A value is not compared with one from long ago."""
    plots = board('jc.position[knee] - js.position[knee]')
    plots.take('jc', state(knee=1.0), 1.0)
    plots.take('js', state(knee=1.0), 3.0)
    assert plots.columns(4.0)['jc.position[knee] - js.position[knee]'][0].tolist() == []


def test_series_that_are_added_later() -> None:
    """A series of a topic whose type is known needs not to be told it again."""
    plots = board('js.position[knee]')
    plots.add('js.position[hip]')
    plots.take('js', state(hip=3.0, knee=1.0), 1.0)
    assert [each.trace.newest for each in plots.plotted] == [1.0, 3.0]


def test_troubles() -> None:
    """What prevents a series from being plotted is written below it, until it is plotted."""
    plots = board('js.position[<knee>]', 'js.speed')
    plots.take('js', state(hip=1.0), 1.0)
    html = legend_html(plots.plotted)
    assert 'There is no element &#x27;&lt;knee&gt;&#x27;, only hip.' in html
    assert 'js has no field &#x27;speed&#x27;' in html
    plots.take('js', state(**{'<knee>': 1.0}), 2.0)
    assert 'There is no element' not in legend_html(plots.plotted)
    assert 'Nothing is plotted yet' in legend_html([])


def test_rest() -> None:
    """What is seen rests while values go on to come; none of them is lost."""
    plots = board('js.position[knee]')
    plots.take('js', state(knee=1.0), 1.0)
    plots.rest(2.0)
    plots.take('js', state(knee=2.0), 3.0)
    before = plots.drawn(2.0)[0].tolist()
    assert str(plots.drawn(50.0)[0].tolist()) == str(before)
    assert plots.columns(50.0)['js.position[knee]'][1].tolist() == [1.0]
    plots.go_on()
    assert plots.columns(4.0)['js.position[knee]'][1].tolist() == [1.0, 2.0]
    plots.clear()
    assert plots.columns(4.0)['js.position[knee]'][1].tolist() == []


def test_too_many_series() -> None:
    """More series than can be told apart are refused; those that are there stay."""
    plots = board(*(f'js.position[{index}]' for index in range(8)))
    plots.add('js.position[0]')
    with pytest.raises(PathError, match='There are already 8 series'):
        plots.add('js.position[8]')
    assert len(plots.plotted) == 8
    plots.remove('js.position[0]')
    plots.add('js.position[8]')


def test_csv() -> None:
    """Each time has a line, with empty cells where a series has no value."""
    columns = {
        'a.x': (np.array([1.0, 2.0]), np.array([0.5, NAN])),
        'b.y, z': (np.array([2.0]), np.array([1e-9])),
    }
    assert csv_text(columns) == 'time_s,a.x,"b.y, z"\n1.000000,0.5,\n2.000000,nan,1e-09\n'


def test_presets() -> None:
    """Presets choose the joints with the largest values, in the order of the robot."""
    names = [f'j{index}' for index in range(9)]
    commanded = {name: float(index) for index, name in enumerate(names)}
    measured = dict.fromkeys(names[:8], 0.0)
    error = tracking_error('jc', 'js', commanded, measured)
    assert error[0] == 'jc.position[j2] - js.position[j2]' and len(error) == MAX_PRESET_JOINTS
    assert effort('js', {'a': NAN, 'b': -2.0}) == ['js.effort[b]']
    assert imu('imu')[0] == 'imu.angular_velocity.x' and len(imu('imu')) == 6
    for text in (*error, *imu('imu')):
        assert str(parse_series(text)) == text
