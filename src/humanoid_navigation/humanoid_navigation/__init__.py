# SPDX-License-Identifier: Apache-2.0
"""Navigation of the humanoid: what it is told, its maps, and what stops it."""
