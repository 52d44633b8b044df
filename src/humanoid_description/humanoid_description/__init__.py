# SPDX-License-Identifier: Apache-2.0
"""The model of the humanoid: its actuators, its scaling, and checks of any robot model."""
