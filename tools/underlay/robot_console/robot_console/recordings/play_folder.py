# SPDX-License-Identifier: Apache-2.0
"""Widgets to play a recording, and a badge that stays visible meanwhile."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from html import escape
import math
import time
from typing import Any

from robot_console.recordings.bags import Bag, BagChooser, commands_among
from robot_console.recordings.child import Child
from robot_console.recordings.widgets import assign, clock_text, listed, mixture_text
from rviz_common.context import Context
from rviz_common.inputs import on_choice
from rviz_common.pace import Pace
from rviz_common.status import escaped, Level

__all__ = ['Badge', 'PlayFolder']

SUBJECT = 'Playing'
RECORDED = 'This is recorded, not live.'
MIXED = 'Recorded and live are mixed.'
# Over the scene and below toasts; not among the widgets, which are 24em wide and which users may
# scroll or collapse.
STYLE = (
    'position: fixed; bottom: 1em; left: max(9em, 50vw - 12em); transform: translateX(-50%); '
    'z-index: 1000; width: max-content; max-width: 17em; '
    'padding: 0.45em 1em; border-radius: 4px; pointer-events: none; '
    'color: #fff; font-size: 0.9em; line-height: 1.35; text-align: center; '
    'overflow-wrap: anywhere; background: '
)
COLORS = {RECORDED: '#7048e8', MIXED: '#c04a06'}

PLAY, PAUSE, STOP = 'Play', 'Pause', 'Stop'
SPEEDS = ('0.1', '0.25', '0.5', '1', '2', '5', '10')
REST_S = 0.4
"""Time in s for which the slider must rest before the player seeks to its position."""
OWN_NODE = 'rosbag2_player'
OF_ALL = ('/parameter_events', '/rosout')
"""Topics of all nodes, which always have live publishers."""


class Badge:
    """
    A badge over the scene, and an entry in the status summary, while a recording is played.

    Parameters
    ----------
    context
        The context of the panel.

    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._said = ('', '')
        self._html: Any = None

    def update(self, name: str, is_mixed: bool = False) -> None:
        """
        Show which recording is played; call it outside any tab.

        Parameters
        ----------
        name
            The name of the recording; '' removes the badge.
        is_mixed
            Whether live nodes publish on the same topics at the same time.

        """
        said = name, MIXED if is_mixed else RECORDED
        if said == self._said:
            return
        self._said = said
        if self._html is not None:
            self._html.remove()
            self._html = None
        if name:
            self._html = self._context.gui.add_html(_html(*said))
        self._say(*said)

    def _say(self, name: str, sentence: str) -> None:
        """Update the entry in the status summary of the page."""
        visualizer = self._context.visualizer
        if visualizer is None:
            return
        if name:
            visualizer.status.say(SUBJECT, Level.WARN, f'{name}. {sentence}')
        else:
            visualizer.status.forget(SUBJECT)


def _html(name: str, sentence: str) -> str:
    style = STYLE + COLORS[sentence]
    return f'<div role="status" style="{style}"><b>PLAYING {escape(name)}</b><br>{sentence}</div>'


class PlayFolder:
    """
    Widgets to play a recording, in a child process.

    Recorded commands are excluded unless they are selected, because a live robot would execute
    them.

    Parameters
    ----------
    context
        The context of the panel.
    folder
        The path of the folder with the recordings.
    commands
        Patterns of the topics that command robots, as for `commands_among`.
    unfinished
        Returns the path of the recording in progress, '' if there is none.

    Attributes
    ----------
    chooser
        The widgets that select the recording.

    """

    def __init__(
        self, context: Context, folder: str, commands: str, unfinished: Callable[[], str]
    ) -> None:
        self._context, self._patterns = context, commands
        self._child: Child | None = None
        self._bag: Bag | None = None
        self._jumps = 0
        self._wish: tuple[float, float] | None = None
        self._mixture_pace = Pace(1.0)
        self._mixture = ''
        self._badge = Badge(context)
        gui = context.gui
        with gui.add_folder('Play'):
            self.chooser = BagChooser(context, folder, unfinished, self._describe)
            self._buttons: Any = gui.add_button_group('Action', (PLAY, PAUSE, STOP))
            self._time: Any = gui.add_slider('Time (s)', 0.0, 1.0, 0.01, 0.0, disabled=True)
            self._speed: Any = gui.add_dropdown('Speed', SPEEDS, initial_value='1')
            self._loop: Any = gui.add_checkbox('Loop', False)
            self._obeyed: Any = gui.add_checkbox(
                'Commands too', False, hint='Also topics that command a robot, such as cmd_vel.'
            )
            self._text: Any = gui.add_markdown('')
            self.chooser.add_details()
        on_choice(context.queue.post, self._buttons, self._press)
        context.on_input(self._time, self._wish_time)
        context.on_input(self._speed, lambda value: self._say(rate=float(value)))
        context.on_input(self._loop, lambda value: self._say(loop=value))
        context.on_input(self._obeyed, lambda value: self._describe())

    def follow(self) -> None:
        """Clear transforms after a jump in time; called per frame, before messages are read."""
        jumps = self._child.facts.get('jumps', 0) if self._child else 0
        if jumps > self._jumps:
            self._forget_frames()
        self._jumps = jumps

    def update(self) -> None:
        """Update the widgets with the state of the player."""
        self.chooser.update()
        child, bag = self._child, self._bag
        if child is None or bag is None:
            self._badge.update('')
            return
        if not child.is_running:
            self._finish(child)
            return
        self._badge.update(bag.name, bool(self._mixture))
        self._follow_wish(child)
        self._show_time(child.facts)
        assign(self._text, content=self._state(child, bag))

    def close(self) -> None:
        """Stop the playback."""
        self.chooser.close()
        if self._child is not None:
            self._child.close()
        self._badge.update('')

    def _press(self, action: str) -> None:
        if action == PLAY:
            self._play()
        elif action == PAUSE:
            self._say(paused=True)
        elif self._child is not None:
            self._child.end()

    def _play(self) -> None:
        chosen = self.chooser.bag
        if self._child is not None and self._child.is_ending:
            return
        if self._child is not None and chosen == self._bag:
            self._say(paused=False)
        elif self._child is not None:
            assign(self._text, content='Stop what is playing first.')
        elif chosen is None:
            assign(self._text, content='✖ Choose a recording that can be played.')
        else:
            self._start(chosen)

    def _start(self, bag: Bag) -> None:
        left_out = self._left_out(bag)
        if len(left_out) == len(bag.topics):
            text = '✖ The recording has only commands, which are left out.'
            assign(self._text, content=text)
            return
        arguments = [bag.path, '--rate', self._speed.value]
        arguments += ['--loop'] if self._loop.value else []
        arguments += ['--exclude-topics', *left_out] if left_out else []
        self._bag, self._child, self._jumps = bag, Child('play', arguments), 0
        self._mixture, self._wish = '', None
        self._show_span(bag)
        assign(self._time, value=0.0, disabled=False)
        assign(self._obeyed, disabled=True)

    def _finish(self, child: Child) -> None:
        child.close()
        self._child = self._bag = None
        self._badge.update('')
        self._forget_frames()
        assign(self._time, value=0.0, disabled=True)
        assign(self._obeyed, disabled=False)
        self._describe()
        if child.failure:
            assign(self._text, content=f'✖ {escaped(child.failure)}')

    def _forget_frames(self) -> None:
        """Clear the tf buffer, so that transforms older than its newest ones are accepted."""
        if self._context.frames is not None:
            self._context.frames.buffer.clear()

    def _say(self, **command: Any) -> None:
        if self._child is not None:
            self._child.say(**command)

    def _wish_time(self, position_s: float) -> None:
        self._wish = position_s, time.monotonic() + REST_S

    def _follow_wish(self, child: Child) -> None:
        """Seek to the selected time; the slider stays there until the player has arrived."""
        if self._wish is None or time.monotonic() < self._wish[1]:
            return
        position_s, _ = self._wish
        self._wish = None
        child.facts = {**child.facts, 'position_s': position_s}
        child.say(position_s=position_s)

    def _show_time(self, facts: dict[str, Any]) -> None:
        if self._wish is None and 'position_s' in facts:
            assign(self._time, value=round(min(facts['position_s'], self._time.max), 2))

    def _state(self, child: Child, bag: Bag) -> str:
        """Format the state of the player."""
        facts = child.facts
        if child.is_ending:
            return 'Stopping ...'
        if 'position_s' not in facts:
            return 'Starting ...'
        word = 'Playing'
        if facts['is_ended']:
            word = 'At the end of'
        elif facts['is_paused']:
            word = 'Paused in'
        at = f'{clock_text(facts["position_s"])} of {clock_text(bag.duration_s)}'
        notes = [f'{word} **{escaped(bag.name)}**: {at}', *child.warnings[-3:]]
        if self._mixture_pace.is_due():
            self._mixture = mixture_text(self._others(bag))
        notes += [self._mixture] if self._mixture else []
        return '\n\n'.join([notes[0], *(f'⚠ {escaped(note)}' for note in notes[1:])])

    def _others(self, bag: Bag) -> dict[str, set[str]]:
        """Return the nodes other than the player that publish on the played topics, by topic."""
        node, ignored = self._context.node, {*self._left_out(bag), *OF_ALL}
        others: dict[str, set[str]] = defaultdict(set)
        for topic in (each.name for each in bag.topics if each.name not in ignored):
            if node.count_publishers(topic) > 1:
                for info in node.get_publishers_info_by_topic(topic):
                    if info.node_name not in (OWN_NODE, node.get_name()):
                        others[topic].add(info.node_name)
        return others

    def _left_out(self, bag: Bag) -> list[str]:
        """Return the topics of a recording that are excluded from playback."""
        if self._obeyed.value:
            return []
        return commands_among((each.name for each in bag.topics), self._patterns)

    def _describe(self) -> None:
        """Show which topics would be excluded from playback."""
        if self._child is not None:
            return
        bag = self.chooser.bag
        if bag is not None:
            self._show_span(bag)
        left_out = self._left_out(bag) if bag is not None else []
        text = f'Left out, as they command a robot: {listed(left_out)}' if left_out else ''
        assign(self._text, content=escaped(text))

    def _show_span(self, bag: Bag) -> None:
        assign(self._time, max=max(math.ceil(bag.duration_s * 100) / 100, 0.01))
