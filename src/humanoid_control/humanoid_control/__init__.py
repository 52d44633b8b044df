# SPDX-License-Identifier: Apache-2.0
"""Nodes that move the joints of the humanoid and watch them."""
