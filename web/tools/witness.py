"""What people who had no part in the voices hear: called by witness.mjs with folders of speech bundles.

PocketSphinx (its English model comes with it) aligns each utterance's words with its sound; DNSMOS P.808 of speechmos
predicts how listeners would rate it, 1 to 5. Prints one JSON object a folder.
"""

import json
import re
import subprocess
import sys

import numpy as np
from pocketsphinx import Decoder
from speechmos import dnsmos

RATE_HZ = 16_000
# Phones of the set `radio` that the CMU dictionary calls otherwise.
CMU = {"ax": "AH", "axr": "ER", "dx": "T"}


def sound(path):
    run = ["ffmpeg", "-v", "error", "-i", path, "-ac", "1", "-ar", str(RATE_HZ), "-f", "f32le", "-"]
    return np.frombuffer(subprocess.run(run, capture_output=True, check=True).stdout, dtype=np.float32)


def words(utterance):
    """Text, phones and begin of each word, seconds."""
    text = utterance["text"].encode()
    phones = utterance["phones"].split()
    ends = np.concatenate([[0], np.cumsum(utterance["msecs"])]) / 1000
    for start, count, first, length in utterance["words"]:
        spelled = text[start : start + count].decode().lower().replace("’", "'")
        spelled = re.sub(r"[^a-z']", "", spelled).strip("'")
        if spelled:
            yield spelled, [p for p in phones[first : first + length] if p != "pau"], ends[first]


def off(decoder, utterance, samples):
    """By how much each word begins later than PocketSphinx finds it, seconds; none where it loses the thread."""
    told = list(words(utterance))
    for word, phones, _ in told:
        if decoder.lookup_word(word) is None:
            decoder.add_word(word, " ".join(CMU.get(p, p.upper()) for p in phones), True)
    level = 0.1 / max(1e-6, float(np.sqrt(np.mean(samples**2))))
    decoder.set_align_text(" ".join(word for word, _, _ in told))
    decoder.start_utt()
    decoder.process_raw((np.clip(samples * level, -1, 1) * 32767).astype("<i2").tobytes(), full_utt=True)
    decoder.end_utt()
    found = [s for s in decoder.seg() or [] if not s.word.startswith(("<", "[", "+", "("))]
    if len(found) != len(told):
        return []
    return [begin - segment.start_frame / 100 for segment, (_, _, begin) in zip(found, told)]


def heard(folder):
    with open(f"{folder}/speech.json") as file:
        bundle = json.load(file)
    is_english = all(voice["language"].startswith("en") for voice in bundle["voices"])
    decoder = Decoder(samprate=RATE_HZ, loglevel="FATAL", bestpath=False)
    begins, scores = [], []
    for utterance in bundle["utterances"]:
        file = next(a["file"] for a in utterance["audio"] if a["file"].endswith(".opus"))
        samples = np.clip(sound(f"{folder}/{file}"), -1, 1)
        scores.append(float(dnsmos.run(samples, RATE_HZ)["p808_mos"]))
        if is_english:
            begins += off(decoder, utterance, samples)
    ms = np.abs(begins) * 1000 if begins else np.array([np.nan])
    return {
        "folder": folder,
        "p808": float(np.mean(scores)),
        "words": len(begins),
        "medianMs": None if not begins else float(np.median(ms)),
        "mostMs": None if not begins else float(np.percentile(ms, 95)),
    }


for folder in sys.argv[1:]:
    print(json.dumps(heard(folder)), flush=True)
