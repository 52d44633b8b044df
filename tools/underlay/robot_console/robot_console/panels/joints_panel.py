# SPDX-License-Identifier: Apache-2.0
"""Panel with the joints of a robot, as a table of HTML that is short to send often."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from math import degrees
import time

from robot_console.joint_states import JointStates, TopicWatch
from robot_console.joint_table import JointRow, JointTable, load_level, position_level, RowGroup
from robot_console.namespaces import NAMESPACE, topic_of_robot
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.polled_topic import PolledTopic
from rviz_common.properties import Topic
from rviz_common.status import Level
from rviz_default_plugins.robot.description import DescriptionTopic
from urdf import parse_urdf, UrdfError

__all__ = ['JointsPanel', 'notes_html', 'table_html']

MAX_ROWS = 300
NONE = '<td>'
CLASSES = {Level.OK: '', Level.WARN: ' w', Level.ERROR: ' e'}
ERROR_RAD, ERROR_M = 0.1, 0.01

STYLE = """<style>
.joints{width:calc(100% - 22px);margin:0 10px 10px 12px;border-collapse:collapse;
font-size:11px;line-height:1.25;font-variant-numeric:tabular-nums}
.joints th{font-weight:600;text-align:right;padding:2px 3px;opacity:.7;border:0}
.joints th:first-child,.joints td:first-child{text-align:left;white-space:nowrap;
overflow:hidden;text-overflow:ellipsis;max-width:9em}
.joints small{display:block;font-weight:400}
.joints .g td{font-weight:700;padding-top:7px;text-align:left}
.joints td{text-align:right;padding:2px 3px;border-bottom:1px solid rgba(128,128,128,.2);
white-space:nowrap}
.joints i{display:inline-block;min-width:4.2em;font-style:normal;opacity:.65}
.joints .p{background:linear-gradient(90deg,transparent calc(var(--t,-9px) - 1px),#e8a33d 0,
#e8a33d calc(var(--t,-9px) + 1px),transparent 0),linear-gradient(90deg,transparent
calc(var(--p) - 2px),var(--c,#4dabf7) 0,var(--c,#4dabf7) calc(var(--p) + 2px),transparent 0),
linear-gradient(rgba(128,128,128,.16) 0 0);background-size:100% 4px;
background-repeat:no-repeat;background-position:0 100%}
.joints .b{background:linear-gradient(90deg,var(--c,#4dabf7) var(--p),rgba(128,128,128,.16) 0)
no-repeat 0 100%/100% 4px}
.joints .w{--c:light-dark(#8a5300,#fab005);color:var(--c)}
.joints .e{--c:light-dark(#c62828,#ff6b6b);color:var(--c);font-weight:700}
.joints .s{opacity:.4}
.joint-notes{margin:0 12px 4px;font-size:11px;line-height:1.4}
.joint-notes .w{color:light-dark(#8a5300,#fab005)}
</style>"""

HEAD = (
    '<tr><th>Joint<th>Position<small>rad</small><th>Error<small>rad</small>'
    '<th>Velocity<small>rad/s</small><th>Effort<small>N m</small>'
)

PERIOD_S = 0.2
DEPTH = 100
DESCRIPTION, MEASURED, COMMANDED = 'Description Topic', 'Joint States Topic', 'Commands Topic'
JOINT_STATE = 'sensor_msgs/msg/JointState'


def table_html(groups: Iterable[RowGroup]) -> str:
    """
    Render the joint table as HTML.

    Parameters
    ----------
    groups
        The rows by limb; rows beyond the first 300 are only counted.

    Returns
    -------
    str
        The table; '' if there are no joints.

    """
    parts = []
    left = MAX_ROWS
    left_out = 0
    for group in groups:
        rows = group.rows[:left]
        left -= len(rows)
        left_out += len(group.rows) - len(rows)
        if rows:
            parts.append(f'<tr class=g><td colspan=5>{escape(group.title)}')
            parts.extend(map(_row, rows))
    more = f'<tr><td colspan=5>{left_out} more; use the search.' if left_out else ''
    body = ''.join(parts)
    return f'<table class=joints>{HEAD}{body}{more}</table>' if body else ''


def notes_html(notes: Iterable[tuple[str, bool]]) -> str:
    """
    Render the notes above the joint table as HTML.

    Parameters
    ----------
    notes : Iterable[tuple[str, bool]]
        Messages, each with whether it is a warning.

    """
    lines = ''.join(
        f'<div class=w>⚠ {escape(text)}</div>' if is_warning else f'<div>{escape(text)}</div>'
        for text, is_warning in notes
    )
    return f'<div class=joint-notes>{lines}</div>'


def _row(row: JointRow) -> str:
    state, joint = row.state, row.joint
    velocity = _load(state.velocity, joint.max_velocity if joint else None, 2)
    effort = _load(state.effort, joint.max_effort if joint else None, 1)
    kind = ' class=s' if row.is_stale else ''
    return f'<tr{kind}><td>{escape(row.label)}{_position(row)}{_error(row)}{velocity}{effort}'


def _position(row: JointRow) -> str:
    position = row.state.position
    if position is None:
        return NONE
    text = f'{position:.3f}<i>{_turned(position)}</i>' if row.is_angle else f'{position:.4f} m'
    share = row.share(position)
    if share is None:
        return f'<td>{text}'
    target = row.share(row.target)
    told = '' if target is None else f';--t:{100 * target:.0f}%'
    level = CLASSES[position_level(row)]
    return f'<td class="p{level}" style="--p:{100 * share:.0f}%{told}">{text}'


def _turned(position: float) -> str:
    return f'{degrees(position):.1f}°'


def _error(row: JointRow) -> str:
    error = row.error
    if error is None:
        return NONE
    is_large = abs(error) > (ERROR_RAD if row.is_angle else ERROR_M)
    return f'<td{" class=w" if is_large else ""}>{error:.3f}'


def _load(value: float | None, maximum: float | None, digits: int) -> str:
    """Render a cell with a bar proportional to the fraction of the maximum."""
    if value is None:
        return NONE
    text = f'{value:.{digits}f}'
    text = text.lstrip('-') if float(text) == 0.0 else text
    if maximum is None:
        return f'<td>{text}'
    share = min(100 * abs(value) / maximum, 100)
    level = CLASSES[load_level(value, maximum)]
    return f'<td class="b{level}" style="--p:{share:.0f}%">{text}'


class JointsPanel(Panel):
    """A table of joints: position, error, velocity and effort, beside their limits."""

    CLASS = 'robot_console/Joints'
    PROPERTIES = (
        NAMESPACE,
        Topic(MEASURED, 'joint_states', 'Topic of the joint states.', JOINT_STATE),
        Topic(COMMANDED, 'joint_commands', 'Topic of the joint commands.', JOINT_STATE),
        Topic(DESCRIPTION, 'robot_description', 'Source of joint limits.', 'std_msgs/msg/String'),
    )

    def start(self) -> None:
        """Add the widgets, and subscribe to the topics."""
        self._table = JointTable()
        self._pace = Pace(PERIOD_S)
        self._topics: list[tuple[PolledTopic, JointStates]] = []
        self._trouble = ''
        gui = self.context.gui
        gui.add_html(STYLE)
        self._search = gui.add_text('Search', '', hint='Part of a name, such as left or knee')
        self.context.on_input(self._search, lambda text: self._pace.hurry())
        self._notes = gui.add_html('')
        self._rows = gui.add_html('')
        self._watches: list[TopicWatch] = []
        self._description: DescriptionTopic | None = None
        try:
            self._listen_all()
        except ValueError as error:
            self._trouble = f'A topic of the panel cannot be subscribed: {error}'

    def update(self) -> None:
        """Update the table if any browser is connected."""
        if not self._pace.is_due() or not self.context.server.get_clients():
            return
        self._take()
        now_s = time.time()
        search = self._search.value
        rows = table_html(self._table.groups(now_s, search))
        found = [] if rows or not search else [(f"No joint has '{search}' in its name.", True)]
        self._notes.content = notes_html([*self._said(now_s), *found])
        self._rows.content = rows

    def close(self) -> None:
        """Destroy the subscriptions."""
        if self._description is not None:
            self._description.close()
        for topic, _ in self._topics:
            topic.close()

    def _topic(self, path: str) -> str:
        return topic_of_robot(self.context.node, self.values['Namespace'], self.values[path])

    def _listen_all(self) -> None:
        for path, states in ((MEASURED, self._table.measured), (COMMANDED, self._table.commanded)):
            self._watches.append(self._listen(self._topic(path), states))
        self._description = DescriptionTopic(
            self.context.node, self._topic(DESCRIPTION), self._describe
        )

    def _listen(self, topic: str, states: JointStates) -> TopicWatch:
        from rclpy.qos import QoSProfile, ReliabilityPolicy
        from sensor_msgs.msg import JointState

        node = self.context.node
        qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._topics.append((PolledTopic(node, JointState, topic, qos), states))
        return TopicWatch(topic, states)

    def _take(self) -> None:
        for topic, states in self._topics:
            for message, time_s in topic.take():
                states.take(
                    message.name, message.position, message.velocity, message.effort, time_s
                )

    def _describe(self, text: str, source: str) -> None:
        try:
            self._table.describe(parse_urdf(text, source))
        except UrdfError as error:
            self._trouble = str(error)
        else:
            self._trouble = ''

    def _said(self, now_s: float) -> list[tuple[str, bool]]:
        """Return the status messages, each with whether it is a warning."""
        node = self.context.node
        said = []
        for watch in self._watches:
            is_late = watch.is_late(now_s)
            publishers = node.count_publishers(watch.topic) if is_late else 1
            said.append((watch.sentence(now_s, publishers), is_late))
        said += [(each.complaint, True) for each in self._states() if each.complaint]
        if self._trouble:
            said.append((self._trouble, True))
        elif not self._table.is_described:
            said.append((f'No limits: no description on {self._topic(DESCRIPTION)} yet.', True))
        return said

    def _states(self) -> tuple[JointStates, JointStates]:
        return self._table.measured, self._table.commanded
