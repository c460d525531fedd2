/** Requirements of the standards for statements: xAPI 1.0.3 (Data, 2.4), the video profile, and cmi5 (9). For tests. */

type Json = { readonly [part: string]: unknown };
interface Component {
  readonly id: string;
  readonly description: Json;
}
export interface SentStatement {
  readonly id: string;
  readonly timestamp: string;
  readonly verb: { readonly id: string };
  readonly object: { readonly id: string; readonly definition: Json };
  readonly result?: Json;
  readonly context: { readonly contextActivities: { readonly [kind: string]: readonly { readonly id: string }[] }; readonly extensions: Json };
  readonly [part: string]: unknown;
}

const UUID = /^[\da-f]{8}-[\da-f]{4}-[1-8][\da-f]{3}-[89ab][\da-f]{3}-[\da-f]{12}$/;
const UTC = /^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d+Z$/;
const DURATION = /^PT\d+(\.\d{1,2})?S$/;
const IRI = /^[a-z][a-z\d+.-]*:[^\s<>"{}|\\^`\p{Cc}]+$/u;
const TYPES = ['true-false', 'choice', 'fill-in', 'long-fill-in', 'matching', 'performance', 'sequencing', 'likert', 'numeric', 'other'];
const NUMBER = /^-?\d+(\.\d+)?$/;
const CMI5 = 'https://w3id.org/xapi/cmi5/context/';
const VIDEO = 'https://w3id.org/xapi/video';

export const verbOf = ({ verb }: SentStatement): string => verb.id.split('/').at(-1) ?? '';

/** Returns true if a text is a valid response for a definition. */
function isResponse(definition: Json, text: string, isPattern: boolean): boolean {
  const ids = (name: string): string[] => ((definition[name] ?? []) as Component[]).map(({ id }) => id);
  const parts = text.split('[,]');
  switch (definition['interactionType']) {
    case 'choice':
      return new Set(parts).size === parts.length && parts.every((part) => ids('choices').includes(part));
    case 'sequencing':
      return parts.every((part) => ids('choices').includes(part));
    case 'matching':
      return parts.every((part) => {
        const [source = '', target = '', ...more] = part.split('[.]');
        return ids('source').includes(source) && ids('target').includes(target) && more.length === 0;
      });
    case 'numeric': {
      const ends = text.split('[:]');
      return (isPattern ? ends.length === 2 && text !== '[:]' : ends.length === 1) && ends.every((end) => (isPattern && end === '') || NUMBER.test(end));
    }
    case 'long-fill-in':
      return parts.length === 1 && !/\[[.:]\]/.test(text);
    default:
      return !/\[[.:]\]/.test(text);
  }
}

function faultsOfScore(score: Json): string[] {
  const { scaled, raw, min, max } = score as { [part: string]: number | undefined };
  const faults = scaled !== undefined && scaled >= -1 && scaled <= 1 ? [] : ['scaled'];
  if (raw === undefined) return faults;
  return min !== undefined && max !== undefined && min < max && min <= raw && raw <= max ? faults : [...faults, 'raw'];
}

function faultsOfQuestion({ object: { definition }, result = {}, context }: SentStatement): string[] {
  const patterns = (definition['correctResponsesPattern'] ?? []) as string[];
  const lists = ['choices', 'source', 'target'].flatMap((name) => (definition[name] === undefined ? [] : [definition[name] as Component[]]));
  const response = result['response'] as string | undefined;
  const isFaulty: { readonly [what: string]: boolean } = {
    'type of activity': definition['type'] !== 'http://adlnet.gov/expapi/activities/cmi.interaction',
    'type of interaction': !TYPES.includes(String(definition['interactionType'])),
    pattern: !patterns.every((pattern) => isResponse(definition, pattern, true)),
    patterns: new Set(patterns).size !== patterns.length,
    response: response !== undefined && !isResponse(definition, response, false),
    success: !['boolean', 'undefined'].includes(typeof result['success']),
    duration: !DURATION.test(String(result['duration'])),
    'ids of components': lists.some((list) => new Set(list.map(({ id }) => id)).size !== list.length || list.some(({ id }) => !/^[\w.-]+$/.test(id))),
    parent: context.contextActivities['parent']?.at(-1) === undefined,
    category: (context.contextActivities['category'] ?? []).some(({ id }) => id.startsWith(CMI5)),
  };
  return Object.keys(isFaulty).filter((what) => isFaulty[what]);
}

/** Returns faults in the results of verbs (cmi5, 9.5), also checked without cmi5. */
function faultsOfCourse(told: SentStatement, isCmi5: boolean): string[] {
  const { result = {}, context } = told;
  const verb = verbOf(told);
  const isJudged = verb === 'passed' || verb === 'failed';
  const categories = (context.contextActivities['category'] ?? []).map(({ id }) => id);
  const has = (name: string) => categories.includes(`${CMI5}categories/${name}`);
  const isOwn = isJudged || ['initialized', 'completed', 'terminated'].includes(verb);
  const isFaulty: { readonly [what: string]: boolean } = {
    success: result['success'] !== (isJudged ? verb === 'passed' : undefined),
    completion: result['completion'] !== (verb === 'completed' ? true : undefined),
    duration: (isJudged || verb === 'completed' || verb === 'terminated') && !DURATION.test(String(result['duration'])),
    score: isCmi5 && isOwn && !isJudged && result['score'] !== undefined,
    'category of cmi5': has('cmi5') !== (isCmi5 && isOwn),
    'category moveon': has('moveon') !== (isCmi5 && (isJudged || verb === 'completed')),
    'category of the profile': categories.includes(VIDEO) === (isJudged || verb === 'scored'),
    length: typeof context.extensions[`${VIDEO}/extensions/length`] !== 'number',
  };
  return Object.keys(isFaulty).filter((what) => isFaulty[what]);
}

/** Returns the faults of a statement, in words. */
export function faultsOf(told: SentStatement, isCmi5: boolean): string[] {
  const { id, timestamp, actor, object, result, context } = told;
  const addresses = [told.verb.id, object.id, String(object.definition['type']), ...Object.values(context.contextActivities).flatMap((list) => list.map((it) => it.id))];
  const maps = [object.definition['name'] as Json, (told.verb as unknown as { display: Json }).display];
  const isFaulty: { readonly [what: string]: boolean } = {
    id: !UUID.test(id),
    timestamp: !UTC.test(timestamp),
    actor: typeof actor !== 'object' || actor === null,
    addresses: !addresses.every((address) => IRI.test(address)) || !Object.keys(context.extensions).every((key) => IRI.test(key)),
    languages: !maps.every((map) => Object.keys(map).every((key) => /^[a-z]{2,3}(-\w+)*$/i.test(key))),
    registration: !UUID.test(String((context as unknown as Json)['registration'])),
    session: isCmi5 && context.extensions[`${CMI5}extensions/sessionid`] === undefined,
    surrogates: /\p{Surrogate}/u.test(JSON.stringify(told)) || /\\ud[89a-f]/i.test(JSON.stringify(told)),
    empty: JSON.stringify(told).includes('null'),
  };
  const score = result?.['score'] as Json | undefined;
  const more = verbOf(told) === 'answered' ? faultsOfQuestion(told) : faultsOfCourse(told, isCmi5);
  return [...Object.keys(isFaulty).filter((what) => isFaulty[what]), ...(score === undefined ? [] : faultsOfScore(score)), ...more].map((fault) => `${verbOf(told)}: ${fault}`);
}

/** Returns the faults in the order of a registration's statements. */
export function faultsOfOrder(all: readonly SentStatement[], isCmi5: boolean): string[] {
  const sessionOf = ({ context }: SentStatement) => context.extensions[`${VIDEO}/extensions/session-id`];
  const sessions = [...new Set(all.map(sessionOf))].map((session) => all.filter((it) => sessionOf(it) === session));
  const faults: string[] = [];
  for (const told of sessions) {
    const verbs = told.map(verbOf);
    const count = (...names: string[]) => verbs.filter((verb) => names.includes(verb)).length;
    if (verbs[0] !== 'initialized' || count('initialized') !== 1) faults.push('initialized first');
    if (count('terminated') > 1 || (count('terminated') === 1 && verbs.at(-1) !== 'terminated')) faults.push('terminated last');
    if (isCmi5 && count('passed', 'failed') > 1) faults.push('judged twice');
    // A statement that an earlier session could not send has the time of its action.
    const own = told.filter(({ timestamp }) => timestamp >= (told[0]?.timestamp ?? ''));
    if (own.some(({ timestamp }, i) => i > 0 && timestamp < own[i - 1]!.timestamp)) faults.push('times');
  }
  const verbs = all.map(verbOf);
  for (const once of ['passed', 'completed']) if (verbs.filter((verb) => verb === once).length > 1) faults.push(`${once} twice`);
  if (verbs.includes('passed') && verbs.lastIndexOf('failed') > verbs.indexOf('passed')) faults.push('failed after passed');
  if (new Set(all.map(({ id }) => id)).size !== all.length) faults.push('an id twice');
  return faults;
}
