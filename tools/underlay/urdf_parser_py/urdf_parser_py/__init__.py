# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions as objects that can be read, changed and written: see the module `urdf`."""
