# SPDX-License-Identifier: BSD-2-Clause
import sys

from .main import main

sys.exit(main())
