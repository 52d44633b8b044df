# SPDX-License-Identifier: Apache-2.0
"""Docking: the server that brings the robot to a dock and away from it, and the types of docks."""

from opennav_docking.docking_server import DockingServer

__all__ = ['DockingServer']
