# SPDX-License-Identifier: Apache-2.0
"""The services of the nodes: save and load maps, pause, and reset."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING

from nav_msgs.srv import GetMap
import numpy as np
from slam_toolbox.srv import (
    Clear,
    ClearQueue,
    DeserializePoseGraph,
    LoopClosure,
    Pause,
    Reset,
    SaveMap,
    SerializePoseGraph,
    ToggleInteractive,
)
from slam_toolbox_py.conversions import make_map
from slam_toolbox_py.storage import PoseGraphFileError, save_map
from std_srvs.srv import Empty

if TYPE_CHECKING:
    from slam_toolbox_py.nodes import SlamToolbox

__all__ = ['SlamServices']

_BY_HAND = 'Interactive mode is not supported'


class SlamServices:
    """
    Offers the services of a node.

    Parameters
    ----------
    node
        The node.
    saves_maps
        Whether to offer save_map.

    """

    def __init__(self, node: SlamToolbox, saves_maps: bool) -> None:
        self._node, self._log = node, node.get_logger()
        self._offer(GetMap, 'dynamic_map', self._get_map)
        self._offer(SerializePoseGraph, 'serialize_map', self._serialize)
        self._offer(DeserializePoseGraph, 'deserialize_map', self._deserialize)
        self._offer(Pause, 'pause_new_measurements', self._pause)
        self._offer(Reset, 'reset', self._reset)
        self._offer(Clear, 'clear_changes', self._clear_changes)
        self._offer(LoopClosure, 'manual_loop_closure', self._close_loops)
        self._offer(ToggleInteractive, 'toggle_interactive_mode', self._toggle)
        if saves_maps:
            self._offer(SaveMap, 'save_map', self._save)

    def offer_clear_queue(self) -> None:
        """Offer the service that clears the scan queue."""
        self._offer(ClearQueue, 'clear_queue', self._clear_queue)

    def offer_clear_localization_buffer(self) -> None:
        """Offer the service that clears the localization buffer; there is none to clear."""
        self._offer(Empty, 'clear_localization_buffer', lambda _, response: response)

    def _offer(self, kind: Any, name: str, answer: Callable[[Any, Any], Any]) -> None:
        self._node.create_service(kind, f'slam_toolbox/{name}', answer)

    def _get_map(self, _: GetMap.Request, response: GetMap.Response) -> GetMap.Response:
        grid = self._node.session.grid()
        if grid is not None:
            frame = self._node.told.current.map_frame
            response.map = make_map(grid, frame, self._node.get_clock().now().to_msg())
        return response

    def _save(self, request: SaveMap.Request, response: SaveMap.Response) -> SaveMap.Response:
        grid = self._node.session.grid()
        if grid is None:
            self._log.warning(
                'Cannot save the map: there is none yet. '
                f"Are scans published on '{self._node.told.current.scan_topic}'?"
            )
            response.result = SaveMap.Response.RESULT_NO_MAP_RECEIEVD
            return response
        try:
            self._log.info(f"Saved the map to '{save_map(grid, request.name.data)}'.")
        except OSError as error:
            self._log.error(f'Cannot save the map: {_reason(error)}')
            response.result = SaveMap.Response.RESULT_UNDEFINED_FAILURE
        return response

    def _serialize(
        self, request: SerializePoseGraph.Request, response: SerializePoseGraph.Response
    ) -> SerializePoseGraph.Response:
        try:
            if not self._node.session.mapper.keyframes:
                raise OSError('there are no scans in it yet')
            path = self._node.session.save(request.filename)
            self._log.info(f"Serialized the map to '{path}'.")
        except OSError as error:
            self._log.error(f'Cannot serialize the map: {_reason(error)}')
            response.result = SerializePoseGraph.Response.RESULT_FAILED_TO_WRITE_FILE
        return response

    def _deserialize(
        self, request: DeserializePoseGraph.Request, response: DeserializePoseGraph.Response
    ) -> DeserializePoseGraph.Response:
        kind = DeserializePoseGraph.Request
        if request.match_type not in (
            kind.START_AT_FIRST_NODE,
            kind.START_AT_GIVEN_POSE,
            kind.LOCALIZE_AT_POSE,
        ):
            self._log.error(
                f'No map was loaded: match_type is {request.match_type}. Give 1 to start at the '
                'first node, 2 to start at initial_pose, or 3 to localize there.'
            )
            return response
        if request.match_type == kind.LOCALIZE_AT_POSE and not self._node.only_localizes:
            self._log.error(
                'No map was loaded: this node builds maps. Give match_type 2, or localize with '
                'localization_slam_toolbox_node.'
            )
            return response
        given = request.initial_pose
        is_given = request.match_type != kind.START_AT_FIRST_NODE
        start = np.array([given.x, given.y, given.theta]) if is_given else None
        try:
            self._node.session.load(request.filename, start, self._node.only_localizes)
        except PoseGraphFileError as error:
            self._log.error(f'No map was loaded. {error}')
            return response
        count = len(self._node.session.mapper.keyframes)
        self._log.info(f"Loaded the map '{request.filename}' with {count} keyframes.")
        self._node.restart()
        return response

    def _pause(self, _: Pause.Request, response: Pause.Response) -> Pause.Response:
        self._node.is_paused = not self._node.is_paused
        self._log.info(
            'Paused: new measurements are ignored.'
            if self._node.is_paused
            else 'Resumed: new measurements are processed again.'
        )
        response.status = True
        return response

    def _reset(self, request: Reset.Request, response: Reset.Response) -> Reset.Response:
        self._node.session.reset()
        self._node.is_paused = bool(request.pause_new_measurements)
        self._node.restart()
        self._log.info('The map was cleared; a new one starts where the robot is.')
        response.result = Reset.Response.RESULT_SUCCESS
        return response

    def _clear_queue(
        self, _: ClearQueue.Request, response: ClearQueue.Response
    ) -> ClearQueue.Response:
        self._log.info(f'Dropped {self._node.clear_queue()} queued scans.')
        response.status = True
        return response

    def _clear_changes(self, _: Clear.Request, response: Clear.Response) -> Clear.Response:
        self._log.warning(f'{_BY_HAND}: there are no changes to clear.')
        return response

    def _close_loops(
        self, _: LoopClosure.Request, response: LoopClosure.Response
    ) -> LoopClosure.Response:
        self._log.warning(f'{_BY_HAND}: loops are closed when the robot returns to a place.')
        return response

    def _toggle(
        self, _: ToggleInteractive.Request, response: ToggleInteractive.Response
    ) -> ToggleInteractive.Response:
        self._log.warning(f'{_BY_HAND}: keyframes cannot be moved by hand.')
        return response


def _reason(error: OSError) -> str:
    where = f" '{error.filename}'" if error.filename else ''
    return f'{error.strerror or error}{where}.'
