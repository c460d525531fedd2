//! Tokens of HamNoSys 4 with their words in SiGML (Hanke 2004).

/// Symmetries and the attributes that they set.
pub(super) const SYMMETRIES: [(&str, &str); 4] = [
    ("hamsymmpar", "both_hands"),
    ("hamsymmlr", "both_hands lr_symm"),
    ("hamalternatingmotion", "outofphase"),
    ("hamnondominant", "nondominant"),
];
/// Hand shapes of SiGML.
pub(super) const SHAPES: [(&str, &str); 12] = [
    ("hamfist", "fist"),
    ("hamflathand", "flat"),
    ("hamfinger2", "finger2"),
    ("hamfinger23", "finger23"),
    ("hamfinger23spread", "finger23spread"),
    ("hamfinger2345", "finger2345"),
    ("hampinch12", "pinch12"),
    ("hampinchall", "pinchall"),
    ("hampinch12open", "pinch12open"),
    ("hamcee12", "cee12"),
    ("hamceeall", "ceeall"),
    ("hamceeopen", "ceeopen"),
];
/// Positions of the thumb and bends.
pub(super) const MODIFIERS: [(&str, &str); 8] = [
    ("hamthumboutmod", "out"),
    ("hamthumbacrossmod", "across"),
    ("hamthumbopenmod", "opposed"),
    ("hamfingerstraightmod", "bent"),
    ("hamfingerbendmod", "round"),
    ("hamfingerhookmod", "hooked"),
    ("hamdoublebent", "dblbent"),
    ("hamdoublehooked", "dblhooked"),
];
/// Digits of the fingers.
pub(super) const FINGERS: [(&str, &str); 5] = [
    ("hamthumb", "1"),
    ("hamindexfinger", "2"),
    ("hammiddlefinger", "3"),
    ("hamringfinger", "4"),
    ("hampinky", "5"),
];
/// Locations on the body.
pub(super) const LOCATIONS: [(&str, &str); 26] = [
    ("hamhead", "head"),
    ("hamheadtop", "headtop"),
    ("hamforehead", "forehead"),
    ("hameyebrows", "eyebrows"),
    ("hameyes", "eyes"),
    ("hamnose", "nose"),
    ("hamnostrils", "nostrils"),
    ("hamear", "ear"),
    ("hamearlobe", "earlobe"),
    ("hamcheek", "cheek"),
    ("hamlips", "lips"),
    ("hamtongue", "tongue"),
    ("hamteeth", "teeth"),
    ("hamchin", "chin"),
    ("hamunderchin", "underchin"),
    ("hamneck", "neck"),
    ("hamshouldertop", "shouldertop"),
    ("hamshoulders", "shoulders"),
    ("hamchest", "chest"),
    ("hamstomach", "stomach"),
    ("hambelowstomach", "belowstomach"),
    ("hamneutralspace", "neutralspace"),
    ("hamupperarm", "upperarm"),
    ("hamelbow", "elbow"),
    ("hamelbowinside", "elbowinside"),
    ("hamlowerarm", "lowerarm"),
];
/// Sides and contacts of locations.
pub(super) const CONTACTS: [(&str, &str); 6] = [
    ("hamlrat", "at"),
    ("hamlrbeside", "beside"),
    ("hamtouch", "touch"),
    ("hamclose", "close"),
    ("hamarmextended", "armextended"),
    ("haminterlock", "interlock"),
];
/// Kinds of repetition.
pub(super) const REPETITIONS: [(&str, &str); 5] = [
    ("hamrepeatfromstart", "fromstart"),
    ("hamrepeatfromstartseveral", "fromstart_several"),
    ("hamrepeatcontinue", "continue"),
    ("hamrepeatcontinueseveral", "continue_several"),
    ("hamrepeatreverse", "reverse"),
];
/// Motions of the wrist.
pub(super) const WRISTS: [(&str, &str); 5] = [
    ("hamnodding", "nodding"),
    ("hamswinging", "swinging"),
    ("hamtwisting", "twisting"),
    ("hamstircw", "stircw"),
    ("hamstirccw", "stirccw"),
];
/// Manners of a motion as its attributes.
pub(super) const MANNERS: [(&str, &str, &str); 10] = [
    ("hamsmallmod", "size", "small"),
    ("hamlargemod", "size", "big"),
    ("hamarcl", "curve", "l"),
    ("hamarcu", "curve", "u"),
    ("hamarcr", "curve", "r"),
    ("hamarcd", "curve", "d"),
    ("hamwavy", "zigzag_style", "wavy"),
    ("hamzigzag", "zigzag_style", "zigzag"),
    ("hamfast", "fast", "true"),
    ("hamslow", "slow", "true"),
];
/// Tokens that need no element of their own.
pub(super) const IGNORED: [&str; 5] = [
    "hamspace",
    "hamcomma",
    "hamfullstop",
    "hamversion40",
    "hambetween",
];
