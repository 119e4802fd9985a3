// SPDX-License-Identifier: LGPL-2.1-or-later
angle = Pi/6;
Include "quarter_plate.geo";
