// SPDX-License-Identifier: Apache-2.0
// Unlit patches receive less than a thousandth of the mean: most are covered, like a floor below a box that
// stands on it. A covered patch loses all that it sends, a lit one in a closed room nothing. The balance
// (solution_balance.comp) counts the two kinds of shooters apart. Then few shots suffice: what each kind loses
// differs little from shot to shot, and how much flux each kind sends is known exactly. Any division is
// right in the mean, since shooters are divided before they shoot. Needs `source` and `balance`.

const float unlit_share = 1e-3;

bool is_unlit(uint i) { return luminance(source[i].rgb) < balance.constant.w; }
