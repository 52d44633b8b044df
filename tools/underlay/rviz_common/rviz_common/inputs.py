# SPDX-License-Identifier: Apache-2.0
"""
What a person does with widgets, brought to another thread.

Callbacks of widgets come in other threads, and also for values that a program sets.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ['Post', 'on_choice', 'on_click', 'on_input']

Post = Callable[[Callable[[], None]], None]
"""Has something done in the right thread, such as `WorkQueue.post`."""


def on_input(post: Post, widget: Any, take: Callable[[Any], None]) -> None:
    """Pass on the value that a person gives to a widget; not those that a program sets."""
    widget.on_update(_passing_on(post, take))


def on_choice(post: Post, group: Any, take: Callable[[str], None]) -> None:
    """Pass on the label of the button of a group that is pressed."""
    group.on_click(_passing_on(post, take))


def on_click(post: Post, button: Any, do: Callable[[], None]) -> None:
    """Do something when a button is pressed."""
    button.on_click(lambda event: post(do))


def _passing_on(post: Post, take: Callable[[Any], None]) -> Callable[[Any], None]:
    def pass_on(event: Any) -> None:
        if event.client is not None:
            value = event.target.value
            post(lambda: take(value))

    return pass_on
