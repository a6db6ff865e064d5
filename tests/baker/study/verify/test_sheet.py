from __future__ import annotations

import numpy as np

from furbake.study.verify.sheet import GAP, row


def test_a_sheet_is_orange_where_the_page_is_brighter() -> None:
    truth = np.full((8, 10), 0.5)
    page_ = truth.copy()
    page_[:, :5], page_[:, 5:] = 1.0, 0.0
    sheet = row(page_, truth).astype(int)
    assert sheet.shape == (8, 30 + 2 * GAP, 3)
    brighter, darker = sheet[0, 20 + 2 * GAP], sheet[0, -1]
    assert brighter[0] > 200 > brighter[2]
    assert darker[2] > 200 > darker[0]
