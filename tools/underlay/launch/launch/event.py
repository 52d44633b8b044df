# SPDX-License-Identifier: Apache-2.0
"""The base class of all events."""

from __future__ import annotations


class Event:
    """Something that happened while the launch runs."""

    name = 'launch.Event'
