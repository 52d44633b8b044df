# SPDX-License-Identifier: Apache-2.0
"""Nodes that move and monitor the joints of the humanoid."""
