# SPDX-License-Identifier: Apache-2.0
"""Dry run of a launch service, without starting anything."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from launch._error_text import error_text
from launch._event_processor import EventProcessor
from launch._rehearsal.recorder import Recorder
from launch.events.include_launch_description import IncludeLaunchDescription
from launch.logging import launch_config

if TYPE_CHECKING:
    from launch._rehearsal.record import Record
    from launch.launch_service import LaunchService


def rehearse(service: LaunchService) -> tuple[Record, int]:
    """
    Visit the launch description of a service without starting anything.

    The tasks of processes are created, but canceled before the event loop runs them. Nothing is
    written to log files.

    Parameters
    ----------
    service
        The service; the first description that was included in it is visited.

    Returns
    -------
    tuple
        The root of the tree of records, and the status that the launch would end with.

    """
    from launch.launch_service import cancel_all_tasks

    context, recorder = service.context, Recorder()
    launch_config.keep_nothing()
    loop = asyncio.new_event_loop()
    try:
        processor = EventProcessor(context, loop)
        context._attach(loop, None)
        context._observer = recorder
        while context._event_queue:
            event = context._event_queue.popleft()
            if isinstance(event, IncludeLaunchDescription):
                processor._handle(event)
                break
    finally:
        context._observer = None
        context._attach(None, None)
        cancel_all_tasks(loop)
        loop.close()
    if processor.first_error is not None:
        recorder.root.facts['error'] = error_text(processor.first_error)
    return recorder.root, processor.return_code
