# SPDX-License-Identifier: Apache-2.0
"""Navigation of the humanoid with Nav2: goals, maps, and a guard that ends goals."""
