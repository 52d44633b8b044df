# SPDX-License-Identifier: Apache-2.0
"""A robot whose planner and executor are real, and whose legs go nowhere."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, ExitStack
import os
from pathlib import Path
import re
import sys
import threading
from typing import Any

from geometry_msgs.msg import TransformStamped
from humanoid_common.qos import EVENT, LATCHED, STATE
from humanoid_common.single_goal import RunningGoal, SingleGoal
from humanoid_common.testing.processes import running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.srv import FindObjects
from llm_planner.skill_executor import SkillExecutor
from llm_planner.task_planner import TaskPlanner
from nav2_msgs.action import ComputePathToPose, NavigateToPose, Spin
from nav_msgs.msg import OccupancyGrid
import pytest
from rclpy.node import Node
from sensor_msgs.msg import Image
from std_msgs.msg import String
from tf2_ros import StaticTransformBroadcaster
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

PLACES = """
surfaces:
  - {name: desk, height: 0.7, outline: [[3.0, 1.0], [4.0, 1.0], [4.0, 1.6], [3.0, 1.6]]}
rooms:
  - {name: hall, outline: [[-2, -2], [2, -2], [2, 2], [-2, 2]]}
  - {name: study, outline: [[2, -2], [6, -2], [6, 2], [2, 2]]}
"""


class Robot(Node):
    """Navigation that goes nowhere, a camera, a map, and a memory with a single mug."""

    def __init__(self, **options: Any) -> None:
        super().__init__('robot', **options)
        self.walks: list[Any] = []
        self.spins: list[float] = []
        self.said: list[str] = []
        self.canceled = 0
        self.is_slow = self.is_walking = False
        self._walks, self._spins, self._paths = (SingleGoal(self, lambda: '') for _ in range(3))
        self._walks.offer(NavigateToPose, 'navigate_to_pose', self._walk)
        self._spins.offer(Spin, 'spin', self._spin)
        self._paths.offer(ComputePathToPose, 'compute_path_to_pose', self._path)
        self.create_service(FindObjects, 'find_objects', lambda _, response: response)
        self.create_subscription(String, 'speech/say', self._hear, EVENT)
        self._objects = self.create_publisher(Detection3DArray, 'objects', LATCHED)
        self._transforms = StaticTransformBroadcaster(self)
        here = TransformStamped(child_frame_id='base_footprint')
        here.header.frame_id = 'map'
        here.transform.rotation.w = 1.0
        self._transforms.sendTransform(here)
        mug = Detection3D(id='red_mug_1')
        for name in ('mug', 'red mug'):
            result = ObjectHypothesisWithPose()
            result.hypothesis.class_id = name
            mug.results.append(result)
        mug.bbox.center.position.x, mug.bbox.center.position.y = 3.2, 1.2
        mug.bbox.center.position.z = 0.75
        mug.bbox.size.x = mug.bbox.size.y = mug.bbox.size.z = 0.1
        self._objects.publish(Detection3DArray(detections=[mug]))
        self._map = self.create_publisher(OccupancyGrid, 'map', LATCHED)
        grid = OccupancyGrid(data=[0, 100, -1, 0, 0, 0])
        grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 1.0
        grid.info.origin.position.x = grid.info.origin.position.y = -1.0
        self._map.publish(grid)
        self._camera = self.create_publisher(Image, 'camera/image_raw', STATE)
        image = Image(height=2, width=2, encoding='rgb8', step=6, data=[255, 0, 0] * 4)
        self.create_timer(0.1, lambda: self._camera.publish(image))

    def forget(self) -> None:
        """Clear what it was told to do, as a robot that has just started."""
        for each in (self.walks, self.spins, self.said):
            each.clear()
        self.canceled = 0

    def _hear(self, message: String) -> None:
        self.said.append(message.data)

    async def _walk(self, goal: RunningGoal) -> None:
        self.walks.append(goal.request.pose.pose.position)
        self.is_walking = True
        try:
            while self.is_slow:
                await goal.tick()
        except BaseException:
            self.canceled += 1
            raise
        finally:
            self.is_walking = False

    async def _spin(self, goal: RunningGoal) -> None:
        self.spins.append(goal.request.target_yaw)

    async def _path(self, goal: RunningGoal) -> None:
        return


class StdioClient:
    """A client of the SDK with the server that it starts, in a task that opens and closes it."""

    def __init__(self, mode: str, command: list[str], *, can_ask: bool) -> None:
        self.asked: Any = None
        """Answers what the server asks at present, if the client can ask anybody."""
        self._opened: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self._is_over = asyncio.Event()
        self._task = asyncio.create_task(self._run(mode, command, can_ask))

    async def _run(self, mode: str, command: list[str], can_ask: bool) -> None:
        from mcp import Client, StdioServerParameters

        async def ask(context: Any, params: Any) -> Any:
            return await self.asked(context, params)

        server = StdioServerParameters(command=command[0], args=command[1:], env=dict(os.environ))
        try:
            asked = ask if can_ask else None
            async with Client(server, mode=mode, elicitation_callback=asked) as client:
                self._opened.set_result(client)
                await self._is_over.wait()
        except BaseException as error:
            if not self._opened.done():
                self._opened.set_exception(error)
            raise

    async def opened(self) -> Any:
        """Return the client of the SDK, when it is connected."""
        return await asyncio.shield(self._opened)

    async def close(self) -> None:
        """End the server."""
        self._is_over.set()
        await asyncio.gather(self._task, return_exceptions=True)


class World:
    """
    A domain of its own, perhaps with a robot in it, and what plays an assistant there.

    The assistant is a coroutine in a thread of its own, while this one runs the nodes.
    """

    def __init__(self, ros: RosSandbox, folder: Path) -> None:
        self.ros = ros
        self.audit = folder / 'audit.jsonl'
        self.places = folder / 'places.yaml'
        self.places.write_text(PLACES)
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        self._clients: dict[tuple[Any, ...], StdioClient] = {}
        self._stack = ExitStack()
        self._servers: dict[tuple[tuple[str, Any], ...], tuple[str, str, Any]] = {}

    def begin_robot(self) -> Robot:
        """Start a robot."""
        robot = self.ros.start(Robot)
        for kind in (SkillExecutor, TaskPlanner):
            self.ros.start(kind, {'places_file': str(self.places)})
        return robot

    def parameters(self, **others: Any) -> dict[str, Any]:
        """Return parameters of the server."""
        return {'places_file': str(self.places), 'audit_log': str(self.audit), **others}

    def command(self, **others: Any) -> list[str]:
        """Return the command of a server that a client starts, or a terminal."""
        told = {
            name: str(value).lower() if isinstance(value, bool) else str(value)
            for name, value in self.parameters(**others).items()
        }
        options = [f'{name}:={value}' for name, value in told.items()]
        return [sys.executable, '-m', 'robot_mcp.robot_mcp', *options]

    @contextmanager
    def http_server(self, **parameters: Any) -> Iterator[tuple[str, str, Any]]:
        """Run a server for HTTP; give its address, its token, and the program."""
        command = self.command(transport='http', port=0, **parameters)
        with running_program(command) as program:
            program.wait_for_output('Bearer ')
            address, token = re.search(
                r'(http://\S+)\nAuthorization: Bearer (\S+)\n', program.output
            ).groups()
            yield address, token, program

    def shared_server(self, **parameters: Any) -> tuple[str, str, Any]:
        """Return the server for HTTP with these parameters, which runs as long as the world."""
        key = tuple(sorted(parameters.items()))
        if key not in self._servers:
            self._servers[key] = self._stack.enter_context(self.http_server(**parameters))
        return self._servers[key]

    async def shared_client(self, mode: str, asked: Any = None, **parameters: Any) -> Any:
        """Return the client over stdio with these parameters, which lives as long as the world."""
        can_ask = asked is not None
        key = (mode, can_ask, *sorted(parameters.items()))
        if key not in self._clients:
            command = self.command(**parameters)
            self._clients[key] = StdioClient(mode, command, can_ask=can_ask)
        self._clients[key].asked = asked
        return await self._clients[key].opened()

    def play(self, script: Callable[[], Awaitable[Any]]) -> Any:
        """Run a coroutine function to its end, and return what it returns."""

        async def limited() -> Any:
            return await asyncio.wait_for(script(), 90.0)

        future = asyncio.run_coroutine_threadsafe(limited(), self._loop)
        self.ros.wait_until(future.done, 100.0, 'the end of what the assistant does')
        return future.result()

    def close(self) -> None:
        """End the clients and the servers."""
        for client in self._clients.values():
            asyncio.run_coroutine_threadsafe(client.close(), self._loop).result(60.0)
        self._stack.close()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()


@contextmanager
def _a_world(folder: Path) -> Iterator[World]:
    """Open a domain of one's own."""
    with ros_sandbox() as ros:
        made = World(ros, folder)
        try:
            yield made
        finally:
            made.close()


@pytest.fixture
def world(tmp_path: Path) -> Iterator[World]:
    """Give a domain without a robot."""
    with _a_world(tmp_path) as made:
        yield made


@pytest.fixture
def robot_of_its_own(world: World) -> Robot:
    """Start a robot in the world, for a test that kills what is connected to it."""
    return world.begin_robot()


@pytest.fixture(scope='module')
def _inhabited(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[World, Robot]]:
    """Start a robot in a domain of its own, for the tests of a module."""
    with _a_world(tmp_path_factory.mktemp('home')) as made:
        yield made, made.begin_robot()


@pytest.fixture
def home(_inhabited: tuple[World, Robot]) -> World:
    """Give the domain with the robot, where no call is noted yet."""
    made, _ = _inhabited
    made.audit.unlink(missing_ok=True)
    return made


@pytest.fixture
def robot(_inhabited: tuple[World, Robot]) -> Iterator[Robot]:
    """Give the robot of `home`, which stands, and was told nothing yet."""
    world, robot = _inhabited
    robot.forget()
    yield robot
    robot.is_slow = False
    world.ros.wait_until(lambda: not robot.is_walking, 60.0, 'a robot that stands')


@pytest.fixture
def until() -> Callable[..., Awaitable[None]]:
    """Give what waits for a condition in a coroutine."""

    async def wait(condition: Callable[[], Any], what: str = 'the condition') -> None:
        for _ in range(1500):
            if condition():
                return
            await asyncio.sleep(0.02)
        raise AssertionError(f'waited in vain for {what}')

    return wait


@pytest.fixture(scope='session', autouse=True)
def own_ros_home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep what is written out of the home of whoever runs the tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_HOME', str(tmp_path_factory.mktemp('ros')))
        patch.delenv('ROBOT_MCP_TOKEN', raising=False)
        yield
