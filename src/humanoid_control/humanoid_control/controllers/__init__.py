# SPDX-License-Identifier: Apache-2.0
"""What decides where joints go, tick by tick, beside the backend."""

from humanoid_control.controllers.interface import Controller

__all__ = ['Controller']
