# SPDX-License-Identifier: Apache-2.0
"""The navigation panel: state of navigation, goals and waypoints."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TYPE_CHECKING

from nav2_rviz_plugins.goal_tool import GoalTool
from nav2_rviz_plugins.interfaces import is_built, MISSING
from nav2_rviz_plugins.managers import COMMANDS
from nav2_rviz_plugins.session import NavigationSession, session_of
from robot_console.live_panel import LivePanel
from robot_console.namespaces import below
from rviz_common.pace import Pace
from rviz_common.page.channel import Viewer
from rviz_common.status import Statuses
from rviz_default_plugins.displays.marker import MarkerArray, MarkerScene
from rviz_default_plugins.tools.publishing import SetInitialPose

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.page.channel import Action
    from rviz_common.tool import Tool

__all__ = ['NavigationPanel']

ROOT = '/world/navigation'
TOOLS = {'goal': GoalTool, 'pose': SetInitialPose}
MOST_LOOPS = 1000


class NavigationPanel(LivePanel):
    """Send a robot somewhere: goals and waypoints, how far it is, and why it did not get there."""

    CLASS = 'nav2_rviz_plugins/Navigation 2'
    FOLLOWS = 'robot_console/Plots'
    PAGE = 'navigation'
    PACKAGE = 'nav2_rviz_plugins'

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Whether the action server of `navigate_to_pose` is available.

        Parameters
        ----------
        node
            The node that looks it up, in the same namespace.

        """
        name = node.resolve_service_name('navigate_to_pose/_action/send_goal')
        return bool(node.count_services(name))

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'missing': '' if is_built() else MISSING}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may call."""
        return {
            'tool': self._use,
            'cancel': lambda viewer, message: self._do('cancel'),
            'command': self._command,
            'collect': self._collect,
            'follow': self._follow,
            'through': lambda viewer, message: self._do('go_through'),
            'clear': lambda viewer, message: self._do('clear'),
            'remove': self._remove,
        }

    def begin(self) -> None:
        """Start monitoring the goals of the robot."""
        self._session: NavigationSession | None = None
        if is_built():
            self._session = session_of(self.context.node, self.values['Namespace'])
        self._told: Any = None
        self._own_tools: dict[str, Tool] = {}
        self._look = Pace(1.0)
        self._scene = MarkerScene(self.context.scene, self.context.frames, ROOT, Statuses())
        self._drawn: Any = None
        self._is_drawing = True

    def greet(self, viewer: Viewer) -> None:
        """
        Send the whole state to a viewer that has just connected.

        Parameters
        ----------
        viewer
            The viewer.

        """
        viewer.tell(**self._state())

    def update(self) -> None:
        """Draw the goals, unless a display does, and send what has changed."""
        session = self._session
        if session is not None:
            session.is_watched = bool(self.channel.viewers)
            self._draw(session)
        super().update()

    def refresh(self) -> None:
        """Send what has changed."""
        if not self.channel.viewers:
            return
        state = self._state()
        if state != self._told:
            self._told = state
            self.channel.tell(**state)

    def end(self) -> None:
        """Stop drawing, and deactivate the tools; active goals continue."""
        for tool in self._own_tools.values():
            if self._in_use() is tool:
                self.context.visualizer.tools.use(None)
            tool.close()
        if self._session is not None:
            self._session.is_watched = False
        self.context.scene.remove_by_name(ROOT)

    def _state(self) -> dict[str, Any]:
        session = self._session
        told = session.told() if session is not None else {}
        in_use = self._in_use()
        name = next((name for name, kind in TOOLS.items() if isinstance(in_use, kind)), '')
        return {**told, 'tool': name, 'frame': self.context.frames.fixed_frame}

    def _in_use(self) -> Tool | None:
        visualizer = self.context.visualizer
        return None if visualizer is None else visualizer.tools.in_use

    def _draw(self, session: NavigationSession) -> None:
        """Draw the markers of goals, unless a display of the page does."""
        if self._look.is_due():
            is_drawing = not self._is_displayed(session)
            if is_drawing != self._is_drawing:
                self._is_drawing, self._drawn = is_drawing, None
        if session.markers is not self._drawn:
            self._drawn = session.markers
            shown = session.markers.markers if self._is_drawing else session.markers.markers[:1]
            self._scene.put(shown, 0)
        self._scene.update(0, lambda namespace: True)

    def _is_displayed(self, session: NavigationSession) -> bool:
        """Whether a display shows the topic of the markers."""
        visualizer, node = self.context.visualizer, self.context.node
        if visualizer is None:
            return False
        topic = node.resolve_topic_name(below(session.namespace, 'waypoints'))
        displays = (getattr(each, 'display', None) for each in visualizer.displays.walk())
        return any(
            isinstance(each, MarkerArray)
            and each.values['Enabled']
            and each.values['Topic/Value']
            and node.resolve_topic_name(each.values['Topic/Value']) == topic
            for each in displays
        )

    def _needed(self) -> NavigationSession:
        if self._session is None:
            raise ValueError(MISSING)
        return self._session

    def _do(self, what: str) -> None:
        getattr(self._needed(), what)()

    def _use(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Activate or deactivate a tool."""
        name = str(message.get('name', ''))
        kind, visualizer = TOOLS.get(name), self.context.visualizer
        if visualizer is None:
            raise ValueError('There are no tools here.')
        is_again = kind is not None and isinstance(visualizer.tools.in_use, kind)
        visualizer.tools.use(None if kind is None or is_again else self._tool(name))

    def _tool(self, name: str) -> Tool:
        """Return the tool from the configuration file, or one of the panel's own."""
        kind = TOOLS[name]
        namespace = self.values['Namespace']
        for each in self.context.visualizer.tools.tools:
            if isinstance(each, kind) and not namespace:
                return each
        if name not in self._own_tools:
            topic = {'Topic': {'Value': below(namespace, 'initialpose')}}
            given = {'Namespace': namespace} if name == 'goal' else topic
            tool: Tool = kind(self.context, f'{ROOT}_{name}', given)
            tool.begin()
            self._own_tools[name] = tool
        return self._own_tools[name]

    def _command(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        command = message.get('command')
        if command not in COMMANDS:
            raise ValueError(f'There is no command {command}.')
        self._needed().command(command)

    def _collect(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Start or stop collecting waypoints with the current tool."""
        session, visualizer = self._needed(), self.context.visualizer
        session.collect(message.get('on') is True)
        if visualizer is not None and session.collects:
            visualizer.tools.use(self._tool('goal'))
        elif visualizer is not None and isinstance(visualizer.tools.in_use, GoalTool):
            visualizer.tools.use(None)

    def _follow(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        loops = message.get('loops')
        if not isinstance(loops, int) or not 0 <= loops <= MOST_LOOPS:
            raise ValueError(f'Loops must be a whole number from 0 to {MOST_LOOPS}.')
        self._needed().follow(loops)

    def _remove(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        index = message.get('index')
        if isinstance(index, int):
            self._needed().remove(index)
