# SPDX-License-Identifier: Apache-2.0
"""Turn natural-language commands into plans, and execute them."""
