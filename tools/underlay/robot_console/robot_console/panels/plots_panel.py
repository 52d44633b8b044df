# SPDX-License-Identifier: Apache-2.0
"""Panel with plots of numeric message fields, which can be exported as CSV."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
import csv
import io
import time
from typing import Any

from robot_console.namespaces import NAMESPACE, topic_of_robot
from robot_console.plots.plot_board import MAX_WINDOW_S, PlotBoard
from robot_console.plots.plot_chart import legend_html, PlotChart, STYLE
from robot_console.plots.series import parse_all, PathError
from robot_console.plots.series_chooser import SeriesChooser
from robot_console.plots.topic_listener import fields_of, TopicListener
from robot_console.plots.traces import Numbers
from robot_console.plots.units import shared_unit
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.properties import Number, Text

__all__ = ['PlotsPanel', 'csv_text']

Columns = Mapping[str, tuple[Numbers, Numbers]]

DRAW_S, WRITE_S, LOOK_S = 0.1, 0.2, 1.0
MIN_WINDOW_S = 2.0
PAUSE, GO_ON, CLEAR, CSV = 'Pause', 'Continue', 'Clear', 'Save CSV'


def csv_text(columns: Columns) -> str:
    """
    Format the curves of a plot as CSV.

    Parameters
    ----------
    columns
        Times (n,) in s and values (n,), by series name.

    Returns
    -------
    str
        A header, and a row for each time at which a series has a value; other cells are empty.

    """
    rows: dict[float, dict[str, float]] = {}
    for name, (times, values) in columns.items():
        for time_s, value in zip(times.tolist(), values.tolist()):
            rows.setdefault(time_s, {})[name] = value
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator='\n')
    writer.writerow(['time_s', *columns])
    for time_s in sorted(rows):
        row = rows[time_s]
        writer.writerow([f'{time_s:.6f}', *(row.get(name, '') for name in columns)])
    return stream.getvalue()


class PlotsPanel(Panel):
    """A plot of some series; a file lists one panel for each plot."""

    CLASS = 'robot_console/Plots'
    PROPERTIES = (
        NAMESPACE,
        Text('Series', '', 'Paths of numbers, separated by semicolons.'),
        Number('Window', 10.0, 'Time span of the plot, in seconds.', MIN_WINDOW_S, MAX_WINDOW_S),
    )

    def start(self) -> None:
        """Add the widgets, and subscribe to the topics."""
        node = self.context.node
        self._board = PlotBoard(self.values['Window'])
        self._listener = TopicListener(node, self.full_name, self._found, self._board.take)
        self._draw, self._write, self._look = Pace(DRAW_S), Pace(WRITE_S), Pace(LOOK_S)
        self._add_widgets()
        try:
            self.show(parse_all(self.values['Series']))
        except PathError as error:
            self._chooser.say(f'Series of the file: {error}')

    def update(self) -> None:
        """Draw new values if any browser is connected."""
        if self._look.is_due():
            self._listen()
        self._chooser.update()
        if self._draw.is_due():
            self._listener.take_all()
            self._show_news()

    def _show_news(self) -> None:
        if not self.context.server.get_clients():
            return
        if not self._board.is_resting:
            self._draw_curves()
        if self._write.is_due():
            self._legend.content = legend_html(self._board.plotted)

    def _draw_curves(self) -> None:
        board = self._board
        unit = shared_unit(each.unit for each in board.plotted)
        self._chart.draw(board.window_s, board.drawn(time.time()), unit)

    def close(self) -> None:
        """Destroy the subscriptions."""
        self._listener.close()
        self._chooser.close()

    def full_name(self, topic: str) -> str:
        """
        Resolve the topic name of a robot to a fully qualified name.

        Parameters
        ----------
        topic
            As for `Plot.full_name`.

        Raises
        ------
        ValueError
            The name is not a valid topic name.

        """
        return topic_of_robot(self.context.node, self.values['Namespace'], topic)

    def show(self, series: Any) -> None:
        """
        Replace the plotted series.

        Parameters
        ----------
        series
            As for `Plot.show`.

        Raises
        ------
        PathError
            There are too many series.

        """
        self._board.replace(series)
        self._follow()

    def add(self, text: str) -> None:
        """
        Add a series to the plot.

        Parameters
        ----------
        text
            As for `Plot.add`.

        Raises
        ------
        PathError
            The text is not a valid series, or there are too many series already.

        """
        self._board.add(text)
        self._follow()

    def remove(self, text: str) -> None:
        """
        Remove a series from the plot.

        Parameters
        ----------
        text
            As for `Plot.remove`.

        """
        self._board.remove(text)
        self._follow()

    def _add_widgets(self) -> None:
        gui = self.context.gui
        gui.add_html(STYLE)
        self._chart = PlotChart(self.context.server)
        self._legend = gui.add_html('')
        self._buttons = gui.add_button_group('Plot', (PAUSE, CLEAR, CSV))
        self._buttons.on_click(self._press)
        window = gui.add_slider(
            'Seconds', MIN_WINDOW_S, MAX_WINDOW_S, step=1.0, initial_value=self._board.window_s
        )
        self.context.on_input(window, self._set_window)
        self._chooser = SeriesChooser(self)

    def _follow(self) -> None:
        """Draw the current series, and subscribe to their topics."""
        plotted = self._board.plotted
        texts = [str(each.series) for each in plotted]
        self.values['Series'] = '; '.join(texts)
        self._draw_curves()
        self._chooser.list_series(texts)
        self._listen()

    def _listen(self) -> None:
        reasons = self._listener.listen(self._board.topics)
        for each in self._board.plotted:
            for path in each.series.paths:
                each.trouble = reasons.get(path.topic, each.trouble)

    def _found(self, topic: str, type_name: str) -> None:
        for each in self._board.plotted:
            each.trouble = ''
        self._board.find_type(topic, type_name, fields_of)

    def _set_window(self, window_s: float) -> None:
        self.values['Window'] = self._board.window_s = window_s
        self._draw_curves()

    def _press(self, event: Any) -> None:
        """Post the action of a button to the node thread; called from a thread of the page."""
        pressed, client = event.target.value, event.client
        self.context.queue.post(lambda: self._do(pressed, client))

    def _do(self, pressed: str, client: Any) -> None:
        if pressed == CLEAR:
            self._board.clear()
        elif pressed == CSV:
            self._send_csv(client)
        elif self._board.is_resting:
            self._board.go_on()
        else:
            self._board.rest(time.time())
        self._buttons.options = (GO_ON if self._board.is_resting else PAUSE, CLEAR, CSV)

    def _send_csv(self, client: Any) -> None:
        text = csv_text(self._board.columns(time.time()))
        name = time.strftime('plot_%Y-%m-%d_%H-%M-%S.csv')
        with suppress(ConnectionError):
            client.send_file_download(name, text.encode())
