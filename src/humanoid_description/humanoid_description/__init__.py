# SPDX-License-Identifier: Apache-2.0
"""The model of the humanoid: its drives, its sizes, and checks of any robot's model."""
