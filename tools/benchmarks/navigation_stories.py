# SPDX-License-Identifier: Apache-2.0
"""Let the walking humanoid find its way where something is not as the map and the start say.

`tools/in_environment python3 tools/benchmarks/navigation_stories.py [STORY ...]`. It walks in the
apartment, with physics, in real time. Ground truth says where it is, and what it touched.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
import inspect
from typing import Any

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_navigation.arrival import Arrival, Place
from humanoid_navigation.testing import NavigatingRobot
from navigation_trials import Belief, REACHED_M, report, robot_at_home
from rclpy.node import Node
from simulation_interfaces.msg import Resource
from simulation_interfaces.srv import DeleteEntity, SetEntityState, SpawnEntity
from std_srvs.srv import Empty

PATIENCE_S = 60.0
HOME: Place = (0.0, 0.0, 0.0)
KITCHEN: Place = (0.7, 2.6, 1.57)
CORRIDOR: Place = (2.7, 0.0, 0.0)
LIVING_ROOM: Place = (2.7, -1.8, -1.57)
BESIDE_THE_TABLE: Place = (4.5, -1.3, -1.57)
BEHIND_THE_TABLE: Place = (4.5, -4.0, -1.57)
DOOR_M = (2.7, -0.7)
"""The door from the corridor to the living room, which has another one to the hall."""


class Stage:
    """
    The robot, and the obstacles in its way.

    Parameters
    ----------
    ros
        The domain of the robot; the stage waits for it.

    Attributes
    ----------
    navigating, belief
        The robot as a client of Nav2, and its own estimate of its pose.

    """

    def __init__(self, ros: RosSandbox) -> None:
        self.ros = ros
        self.navigating, self.belief = NavigatingRobot(ros), Belief(ros)
        self._node = ros.start(lambda **options: Node('stage', **options))

    @property
    def robot(self) -> Any:
        """The simulated robot."""
        return self.navigating.robot

    def begin(self) -> None:
        """Reset the robot to its home pose, with a correct pose estimate."""
        self.robot.reset()
        self.navigating.say_where(*HOME)
        self.robot.wait(2.0)

    def ask(self, kind: Any, name: str, request: Any) -> Any:
        """
        Call a service and return its response.

        Parameters
        ----------
        kind, name
            The type and the name of the service.
        request
            The request.

        """
        client = self._node.create_client(kind, name)
        self.ros.wait_until(client.service_is_ready, PATIENCE_S, f'the service {name}')
        future = client.call_async(request)
        self.ros.wait_until(future.done, PATIENCE_S, f'an answer of {name}')
        self._node.destroy_client(client)
        return future.result()

    def put_box(self, name: str, centre_m: tuple[float, float], size_m: tuple[float, ...]) -> None:
        """
        Spawn a box of 20 kg that stands on the floor.

        Parameters
        ----------
        name
            The name of the new entity.
        centre_m
            x, y of its centre in the world.
        size_m
            Its extents along x, y and z.

        Raises
        ------
        AssertionError
            The simulator cannot spawn it.

        """
        text = f'{{shape: box, size: {list(size_m)}, mass: 20.0}}'
        request = SpawnEntity.Request(name=name, entity_resource=Resource(resource_string=text))
        _place(request.initial_pose.pose, centre_m, size_m[2])
        answer = self.ask(SpawnEntity, '/simulator/spawn_entity', request)
        assert answer.result.result == 1, answer.result.error_message

    def move_box(self, name: str, centre_m: tuple[float, float], height_m: float) -> None:
        """
        Move a box to another place on the floor.

        Parameters
        ----------
        name
            The name of the entity.
        centre_m
            x, y of its centre in the world.
        height_m
            The height of the box, half of which its centre is above the floor.

        Raises
        ------
        AssertionError
            The simulator cannot move it.

        """
        request = SetEntityState.Request(entity=name)
        _place(request.state.pose, centre_m, height_m)
        answer = self.ask(SetEntityState, '/simulator/set_entity_state', request)
        assert answer.result.result == 1, answer.result.error_message

    def take_box(self, name: str) -> None:
        """
        Delete a box.

        Parameters
        ----------
        name
            The name of the entity.

        """
        self.ask(DeleteEntity, '/simulator/delete_entity', DeleteEntity.Request(entity=name))


def _place(pose: Any, centre_m: tuple[float, float], height_m: float) -> None:
    pose.position.x, pose.position.y = centre_m
    pose.position.z = height_m / 2.0


def blocked_door(stage: Stage) -> Arrival:
    """
    Walk a detour when the door is blocked by an object that is not in the map.

    Parameters
    ----------
    stage
        The robot and its obstacles.

    """
    stage.navigating.go(*CORRIDOR)
    stage.put_box('blockade', DOOR_M, (1.1, 0.25, 1.1))
    arrival = stage.navigating.go(*LIVING_ROOM, at_most_s=240.0)
    stage.take_box('blockade')
    return arrival


def kidnapped(stage: Stage) -> Arrival:
    """
    Localize after an initial pose that is 1 m off.

    Parameters
    ----------
    stage
        The robot and its obstacles.

    """
    stage.navigating.say_where(HOME[0] - 1.0, HOME[1], HOME[2])
    return stage.navigating.go(*KITCHEN)


def lost(stage: Stage) -> Arrival:
    """
    Localize globally without an initial pose, by turning and walking about.

    Parameters
    ----------
    stage
        The robot and its obstacles.

    """
    stage.ask(Empty, '/reinitialize_global_localization', Empty.Request())
    for forward, turn, time_s in ((0.0, 0.5, 13.0), (0.2, 0.0, 8.0), (0.0, 0.5, 13.0)):
        stage.robot.drive(forward, 0.0, turn)
        stage.robot.wait(time_s)
    stage.robot.drive()
    off_m, off_deg = stage.belief.error(stage.navigating)
    print(f'     its estimated pose is {off_m:.2f} m and {off_deg:.0f} degrees off')
    return stage.navigating.go(*KITCHEN)


def pushed_chair(stage: Stage) -> Arrival:
    """
    Walk around an obstacle that is pushed into the way while it walks.

    Parameters
    ----------
    stage
        The robot and its obstacles.

    """
    size_m = (0.4, 0.4, 1.0)
    stage.navigating.go(*BESIDE_THE_TABLE)
    stage.put_box('chair', (5.3, -2.8), size_m)
    handle = stage.navigating.start(*BEHIND_THE_TABLE)
    stage.robot.wait_until(lambda: stage.robot.pose.position_m.imag < -1.4, 60.0)
    for step in range(11):
        stage.move_box('chair', (5.3 - 0.1 * step, -2.8), size_m[2])
        stage.robot.wait(0.1)
    arrival = stage.navigating.finish(handle, *BEHIND_THE_TABLE, 120.0)
    stage.take_box('chair')
    return arrival


STORIES: dict[str, tuple[Callable[[Stage], Arrival], Place]] = {
    'blocked_door': (blocked_door, LIVING_ROOM),
    'kidnapped': (kidnapped, KITCHEN),
    'lost': (lost, KITCHEN),
    'pushed_chair': (pushed_chair, BEHIND_THE_TABLE),
}


def main() -> int:
    """Run the stories, and print a line for each; return 1 if any failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('stories', nargs='*', help=f'{", ".join(STORIES)}; all by default')
    parser.add_argument('--launch', nargs='*', default=[], help='further arguments of the launch')
    options = parser.parse_args()
    names = options.stories or list(STORIES)
    if unknown := set(names) - set(STORIES):
        parser.error(f'no such story: {", ".join(sorted(unknown))}')
    bad = 0
    with ros_sandbox() as ros, robot_at_home(*options.launch):
        stage = Stage(ros)
        for number, name in enumerate(names, 1):
            story, goal = STORIES[name]
            stage.begin()
            title = (inspect.getdoc(story) or '').partition('\n')[0]
            print(f'{name}: {title}', flush=True)
            arrival = story(stage)
            report(number, goal, arrival)
            bad += (
                not arrival.is_reached or arrival.distance_m > REACHED_M or bool(arrival.touched)
            )
    return int(bad > 0)


if __name__ == '__main__':
    raise SystemExit(main())
