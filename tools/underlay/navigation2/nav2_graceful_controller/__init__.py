# SPDX-License-Identifier: Apache-2.0
"""The graceful controller, a controller plugin."""

from nav2_graceful_controller.graceful_controller import GracefulController

__all__ = ['GracefulController']
