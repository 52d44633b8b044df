# SPDX-License-Identifier: Apache-2.0
"""The container node, which loads components into its process, and its executables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import gc
import threading
import traceback
from typing import Any

from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from nav2_util.services import create_async_service, wait_for
from nav2_util.timing import give_way
from rclcpp_components.registry import ComponentError, find_component
from rclcpp_components.shared_clock import SharedClock
import rclpy
from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor, MultiThreadedExecutor
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future
from tf2_ros.executing import make_executor, spin_until
from tf2_ros.program import run, spin, wait_for_signal

__all__ = [
    'ComponentContainer',
    'run_container',
    'run_container_isolated',
    'run_container_mt',
]

_END_S = 3.0
_LOOK_S = 0.02


@dataclass
class _Loaded:
    """Loaded component, with the shutdown function of its own thread if it has one."""

    node: Node
    name: str
    stop: Future[None] | None = None
    thread: threading.Thread | None = None


class ComponentContainer(Node):
    """
    Container that loads, lists and unloads nodes by the services of `composition_interfaces`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    is_isolated
        Whether each component gets its own executor and thread.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(
        self, node_name: str = 'ComponentManager', is_isolated: bool = False, **options: Any
    ) -> None:
        super().__init__(
            node_name, automatically_declare_parameters_from_overrides=True, **options
        )
        self._is_isolated = is_isolated
        self._components: dict[int, _Loaded] = {}
        self._count = 0
        self._shared_clock = SharedClock(self.context)
        self.create_service(LoadNode, '~/_container/load_node', self._load)
        create_async_service(self, UnloadNode, '~/_container/unload_node', self._unload)
        self.create_service(ListNodes, '~/_container/list_nodes', self._list)

    def destroy_node(self) -> None:
        """Unload all components, the newest first, and destroy the node."""
        for uid in sorted(self._components, reverse=True):
            loaded = self._components.pop(uid)
            self._stop(loaded)
            self._destroy(loaded)
        super().destroy_node()

    def _load(self, request: LoadNode.Request, response: LoadNode.Response) -> LoadNode.Response:
        try:
            loaded = self._made(request)
        except ComponentError as error:
            response.error_message = str(error)
            self.get_logger().error(response.error_message)
            if self.executor is not None:
                self.executor.create_task(gc.collect)  # a partly constructed node
            return response
        self._count += 1
        self._components[self._count] = loaded
        self.get_logger().info(f"Loaded '{request.plugin_name}' as '{loaded.name}'")
        response.success, response.unique_id = True, self._count
        response.full_node_name = loaded.name
        return response

    def _made(self, request: LoadNode.Request) -> _Loaded:
        kind = find_component(request.package_name, request.plugin_name)
        try:
            node = kind(**self._options(request))
        except Exception as error:
            self.get_logger().debug(traceback.format_exc())
            raise ComponentError(
                f"Component constructor of '{request.plugin_name}' threw an exception: "
                f'{type(error).__name__}: {error}'
            ) from error
        if request.log_level:
            node.get_logger().set_level(LoggingSeverity(request.log_level))
        loaded = _Loaded(node, node.get_fully_qualified_name())
        if loaded.name in [other.name for other in self._components.values()]:
            self.get_logger().warning(f"There are two nodes named '{loaded.name}' now")
        self._start(loaded)
        return loaded

    def _options(self, request: LoadNode.Request) -> dict[str, Any]:
        """Make the keyword arguments of a component."""
        words: list[str] = []
        if request.node_name:
            words += ['-r', f'__node:={request.node_name}']
        if request.node_namespace:
            words += ['-r', f'__ns:={request.node_namespace}']
        for rule in request.remap_rules:
            words += ['-r', rule]
        forwarded = {
            each.name: Parameter.from_parameter_msg(each).value for each in request.extra_arguments
        }
        return {
            'context': self.context,
            'cli_args': ['--ros-args', *words] if words else None,
            'use_global_arguments': bool(forwarded.get('forward_global_arguments', False)),
            'parameter_overrides': [
                Parameter.from_parameter_msg(each) for each in request.parameters
            ],
        }

    def _start(self, loaded: _Loaded) -> None:
        """Add the nodes of a component to this executor, or to one of their own."""
        executor = self.executor
        if self._is_isolated:
            executor = make_executor(self.context)
            loaded.stop = Future()
            loaded.thread = threading.Thread(
                target=self._work, args=(executor, loaded), name=loaded.name, daemon=True
            )
        loaded.node.share_clock = self._share_clock  # for nodes that it creates later
        for node in _nodes(loaded):
            self._share_clock(node)
            _add(node, executor)
        if loaded.thread is not None:
            loaded.thread.start()

    def _share_clock(self, node: Node) -> None:
        listener = self._shared_clock.take(node)
        if listener is not None:
            _add(listener, self.executor)

    def _work(self, executor: Executor, loaded: _Loaded) -> None:
        assert loaded.stop is not None
        try:
            spin_until(executor, loaded.stop, self.context)
        except Exception:
            self.get_logger().fatal(f"'{loaded.name}' has failed:\n{traceback.format_exc()}")
        finally:
            executor.shutdown()

    def _stop(self, loaded: _Loaded) -> None:
        """Remove the nodes of a component from their executor."""
        if loaded.stop is not None and loaded.thread is not None:
            loaded.stop.set_result(None)
            loaded.thread.join(_END_S)
        for node in _nodes(loaded):
            if node.executor is not None:
                node.executor.remove_node(node)

    def _destroy(self, loaded: _Loaded) -> None:
        nodes = _nodes(loaded)
        loaded.node.destroy_node()
        for node in nodes:
            if _is_alive(node):  # shared with others, such as the transform listener
                _add(node, self.executor)
            else:
                self._shared_clock.release(node)

    async def _wind_up(self, loaded: _Loaded) -> None:
        """Wait for the goals of a component to end in its executor, if it has any."""
        executor = loaded.node.executor
        if executor is None or not hasattr(loaded.node, 'wind_up'):
            return
        end = executor.create_task(loaded.node.wind_up)
        left_s = _END_S
        while not end.done() and left_s > 0.0:
            await wait_for(self, Future(), _LOOK_S)
            left_s -= _LOOK_S

    async def _unload(
        self, request: UnloadNode.Request, response: UnloadNode.Response
    ) -> UnloadNode.Response:
        loaded = self._components.pop(request.unique_id, None)
        if loaded is None:
            response.error_message = f'No node found with unique_id: {request.unique_id}'
            self.get_logger().warning(response.error_message)
            return response
        await self._wind_up(loaded)
        self._stop(loaded)
        await give_way(self)  # events of the nodes may still be in the queue of the executor
        self._destroy(loaded)
        del loaded
        await give_way(self)
        gc.collect()  # otherwise rclpy keeps the lifecycle of a node, and with it the node
        response.success = True
        return response

    def _list(self, _: ListNodes.Request, response: ListNodes.Response) -> ListNodes.Response:
        response.unique_ids = list(self._components)
        response.full_node_names = [loaded.name for loaded in self._components.values()]
        return response


def _nodes(loaded: _Loaded) -> list[Node]:
    return [loaded.node, *getattr(loaded.node, 'companions', ())]


def _is_alive(node: Node) -> bool:
    try:
        with node.handle:
            return True
    except InvalidHandle:
        return False


def _add(node: Node, executor: Executor | None) -> None:
    if executor is not None and node.executor is None:
        executor.add_node(node)


def run_container(kind: str = '', arguments: Sequence[str] | None = None) -> int:
    """
    Spin a container until it is told to stop; return the exit status.

    Parameters
    ----------
    kind
        '' for one executor with one thread for all components, 'mt' for several threads, and
        'isolated' for an executor with its own thread for each component.
    arguments : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    """

    def work(words: list[str]) -> int:
        node = ComponentContainer(is_isolated=kind == 'isolated' or '--isolated' in words)
        if kind == 'mt' or '--use_multi_threaded_executor' in words:
            _spin_in_threads(node)
        else:
            spin(node)
        node.destroy_node()
        return 0

    return run(list, work, arguments)


def _spin_in_threads(node: ComponentContainer) -> None:
    threads = node.get_parameter_or('thread_num', Parameter('thread_num', value=0)).value
    executor = MultiThreadedExecutor(threads or None, context=node.context)
    executor.add_node(node)
    stop = threading.Event()

    def work() -> None:
        while not stop.is_set() and rclpy.ok(context=node.context):
            executor.spin_once()

    thread = threading.Thread(target=work, name='node', daemon=True)
    thread.start()
    wait_for_signal(None)
    stop.set()
    executor.create_task(lambda: None)  # wakes the executor
    thread.join(_END_S)
    executor.shutdown(_END_S)  # not before: shutdown while spinning fails


def run_container_mt() -> int:
    """Spin a container whose components share several threads."""
    return run_container('mt')


def run_container_isolated() -> int:
    """Spin a container in which each component has its own thread."""
    return run_container('isolated')
