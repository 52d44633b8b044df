# SPDX-License-Identifier: Apache-2.0
"""Panel with the state of a robot in words, and buttons for the robot and its simulator."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib.resources import files
import time
from typing import Any

from robot_console.control import stopped_by
from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from robot_console.panels.safety import RealTimeFactor
from robot_console.robot_link import LATCHED, link_of
from robot_console.service_calls import ServiceCalls
from robot_console.simulator_link import failure_of, SILENT, SimulatorLink
from robot_console.state_words import slowness, words
from rviz_common.pace import Pace
from rviz_common.page.channel import Action, Viewer
from rviz_common.properties import Text, Whole
from rviz_common.widget_order import BAR_ORDER
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import (
    LoadWorld,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
)
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger

__all__ = ['Robot']

NO_STAND_UP = "Nothing can stand this robot up: there is no service '{}'. A simulator offers it."
LOAD_S = 60.0
"""The time that a simulator may take to load a scene."""


class Robot(LivePanel):
    """
    The state of a robot in words; buttons to stand it up, reset, pause and step, and its scenes.

    The simulator is the node that offers the services of `simulation_interfaces`. While the panel
    is shown, the page has its title, and the icon of the console.

    """

    CLASS = 'robot_console/Robot'
    PAGE = 'robot'
    IS_ALWAYS_VISIBLE = True
    ORDER = BAR_ORDER
    PROPERTIES = (
        NAMESPACE,
        Text('Title', 'Robot', 'Name of the page in browsers.'),
        Text('Simulator', '', 'Node of the simulator; empty: the only one that is running.'),
        Whole('Steps', 50, 'Steps of physics for each press of Step.', 1, 100_000),
    )

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {
            'namespace': self.values['Namespace'],
            'steps': self.values['Steps'],
            'title': self.values['Title'],
        }

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {
            'stand_up': self._stand_up,
            'reset': self._reset,
            'pause': lambda viewer, message: self._set(viewer, SimulationState.STATE_PAUSED),
            'play': lambda viewer, message: self._set(viewer, SimulationState.STATE_PLAYING),
            'step': self._step,
            'world': self._load,
        }

    def begin(self) -> None:
        """Subscribe to the state of the robot, and name the page."""
        node, namespace = self.context.node, self.values['Namespace']
        self._link = link_of(self.context, namespace)
        self._calls = ServiceCalls(node)
        wanted = self.values['Simulator']
        self._simulator = SimulatorLink(
            node, self._calls, self.full_name(wanted) if wanted else '', namespace
        )
        self._stand_up_name = self.full_name('stand_up')
        self._topic = self.full_name('walking_state')
        self._walking = ''
        self._can_rise = self._is_told = self._gets_up = False
        self._pending: set[str] = set()
        self._look = Pace(1.0)
        self._subscriptions = [
            node.create_subscription(String, self._topic, self._take, LATCHED),
            node.create_subscription(
                Bool, self.full_name('gets_up_by_itself'), self._take_gets_up, LATCHED
            ),
        ]
        self._factor = RealTimeFactor(node)
        icon = files('robot_console') / 'web' / 'icon.svg'
        self.context.page.present(self.values['Title'], icon.read_text(encoding='utf-8'))

    def greet(self, viewer: Viewer) -> None:
        """
        Send the state to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._tell(viewer)

    def update(self) -> None:
        """Process pending service calls, follow the simulator, and send updates."""
        self._calls.update()
        if self.channel.viewers:
            self._simulator.update()
        super().update()

    def refresh(self) -> None:
        """Send the state if it has changed."""
        if not self.channel.viewers:
            return
        if self._look.is_due():
            self._examine_graph()
        for viewer in self.channel.viewers:
            self._tell(viewer)

    def end(self) -> None:
        """Destroy the subscriptions and clients, and give the page its own title again."""
        self._simulator.close()
        self._calls.close()
        self._factor.close()
        for subscription in self._subscriptions:
            self.context.node.destroy_subscription(subscription)
        self.context.page.present(self.context.page.title)

    def _take(self, message: String) -> None:
        self._walking = message.data

    def _take_gets_up(self, message: Bool) -> None:
        self._gets_up = message.data

    def _examine_graph(self) -> None:
        """Look up whether nodes report the state, and whether one can stand the robot up."""
        node = self.context.node
        if not node.count_publishers(self._topic):
            self._walking, self._gets_up = '', False
        self._can_rise = node.count_services(self._stand_up_name) > 0
        self._is_told = node.count_publishers(self._link.state_topic) > 0

    def _tell(self, viewer: Viewer) -> None:
        """Send the state to a viewer if it has changed."""
        state = self._state(self._link.people.name(viewer.key))
        if state != viewer.wish:
            viewer.wish = state
            viewer.tell(**state)

    def _state(self, person: str) -> dict[str, Any]:
        """Return what the page of a person shows."""
        simulator = self._simulator
        is_loading = 'world' in self._pending
        return {
            'words': words(
                self._walking or None,
                self._stopped_by(person),
                self._link.holds_because if self._is_told else '',
                SimulationState.STATE_LOADING_WORLD if is_loading else simulator.state,
                self._can_rise,
                self._gets_up,
            ),
            'slow': slowness(self._factor.factor(time.monotonic())),
            'why': self._reasons(),
            'paused': simulator.state not in (None, SILENT, SimulationState.STATE_PLAYING),
            'worlds': [
                [each.world_resource.uri, each.name, each.description] for each in simulator.worlds
            ],
            'world': simulator.world,
        }

    def _stopped_by(self, person: str) -> str:
        """Describe to a person who has pressed the emergency stop; '' while it is not pressed."""
        stop = self._link.stop
        if not stop.pressed:
            return ''
        return stopped_by(stop.by, person, set() if stop.by else self._link.stop_publishers())

    def _reasons(self) -> dict[str, str]:
        """Return why each button is disabled; '' for those that can be pressed."""
        simulator = self._simulator
        is_playing = simulator.state == SimulationState.STATE_PLAYING
        why = {
            'stand_up': '' if self._can_rise else NO_STAND_UP.format(self._stand_up_name),
            'reset': simulator.why_not('reset_simulation'),
            'pause': simulator.why_not('set_simulation_state'),
            'step': simulator.why_not('step_simulation')
            or ('Pause the simulation first.' if is_playing else ''),
            'world': simulator.why_not('load_world')
            or ('' if simulator.worlds else 'The simulator has no scenes to choose from.'),
        }
        return {
            button: reason or ('Please wait.' if button in self._pending else '')
            for button, reason in why.items()
        }

    def _check(self, button: str) -> None:
        """Raise ValueError if a button is disabled, as it may be by now."""
        reason = self._reasons()[button]
        if reason:
            raise ValueError(reason)

    def _stand_up(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        self._check('stand_up')
        answer = self._answering(viewer, 'stand_up')
        self._calls.call(Trigger, self._stand_up_name, Trigger.Request(), answer)

    def _reset(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        self._ask(viewer, 'reset', 'reset_simulation', ResetSimulation.Request())

    def _set(self, viewer: Viewer, state: int) -> None:
        request = SetSimulationState.Request(state=SimulationState(state=state))
        self._ask(viewer, 'pause', 'set_simulation_state', request)

    def _step(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        request = StepSimulation.Request(steps=self.values['Steps'])
        self._ask(viewer, 'step', 'step_simulation', request)

    def _load(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Load a scene; it starts at once if the last one was running."""
        uri = str(message.get('uri', ''))
        if all(each.world_resource.uri != uri for each in self._simulator.worlds):
            raise ValueError('The simulator no longer offers this scene.')
        was_playing = self._simulator.state == SimulationState.STATE_PLAYING

        def go_on() -> None:
            self._simulator.ask_for_worlds()  # the state need not have changed
            if was_playing and not self._reasons()['pause']:
                self._set(viewer, SimulationState.STATE_PLAYING)

        self._ask(viewer, 'world', 'load_world', LoadWorld.Request(uri=uri), LOAD_S, go_on)

    def _ask(
        self,
        viewer: Viewer,
        button: str,
        service: str,
        request: Any,
        timeout_s: float = 5.0,
        then: Callable[[], None] = lambda: None,
    ) -> None:
        """Call a service of the simulator, or raise ValueError if the button is disabled."""
        self._check(button)
        self._simulator.call(service, request, self._answering(viewer, button, then), timeout_s)

    def _answering(
        self, viewer: Viewer, button: str, then: Callable[[], None] = lambda: None
    ) -> Callable[[Any, str], None]:
        """Disable a button until its request is answered, and return what takes the answer."""
        self._pending.add(button)

        def answer(response: Any, failed: str) -> None:
            self._pending.discard(button)
            reason = failed or failure_of(response)
            viewer.tell(said=reason)
            self._simulator.hurry()
            if not reason:
                then()

        return answer
