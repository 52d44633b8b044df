# SPDX-License-Identifier: Apache-2.0
"""A lifecycle node; its parameter `fails` names a transition that does not succeed."""

from __future__ import annotations

import os
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Talker(LifecycleNode):
    """Does what it is asked for, but for one transition."""

    def on_configure(self, state: Any) -> TransitionCallbackReturn:
        """Succeed, fail or end the process."""
        if self._fails('die'):
            os._exit(3)
        if self._fails('configure'):
            return TransitionCallbackReturn.FAILURE
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: Any) -> TransitionCallbackReturn:
        """Succeed or fail."""
        if self._fails('activate'):
            return TransitionCallbackReturn.FAILURE
        return super().on_activate(state)

    def _fails(self, transition: str) -> bool:
        if not self.has_parameter('fails'):
            self.declare_parameter('fails', '')
        return bool(self.get_parameter('fails').value == transition)


def main() -> None:
    """Run the node until it is told to end."""
    rclpy.init()
    try:
        rclpy.spin(Talker('talker'))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
