// Made by script/make-wire from meshforge.studio.wire and meshforge.studio.edits; change it there.

export type AnyEdit =
  | LabelHulls
  | SetVocabulary
  | RenameLabel
  | SetUp
  | SetSteps
  | MoveRule
  | DeleteRule
  | SetOrientation
  | SetLandmarks
  | ReplyToQuestion
  | AnswerForRule
  | TakeBack
  | SetGoal
  | WriteProgram
  | CutHull
  | Unprepare
  | DismissSpanning
  | ReviewAssets
  | ExcludeAssets
  | CorrectByHand
  | DropManualEdits;
export type Event =
  | Start
  | Hello
  | CardsChanged
  | AssetsChanged
  | ProjectChanged
  | HistoryChanged
  | OutcomeChanged
  | ReachChanged
  | AssessmentChanged
  | ProgramChanged
  | JobChanged;
export type JobRequest = ApplyJob | DecomposeJob | PreviewJob | RebuildJob | ExportJob | LabelJob | CheckJob;
export type NewProject = ProjectOfFolder | ProjectOfUpload | ProjectOfFamily | ProjectOfTour;

export interface Everything {
  ActionCall: ActionCall;
  ActionForm: ActionForm;
  ActionView: ActionView;
  AnswerForRule: AnswerForRule;
  AnswerView: AnswerView;
  AnyEdit: AnyEdit;
  ApplyJob: ApplyJob;
  Argument: Argument;
  ArgumentValue: ArgumentValue;
  AssessmentChanged: AssessmentChanged;
  AssessmentView: AssessmentView;
  AssetView: AssetView;
  AssetsChanged: AssetsChanged;
  AssetsFound: AssetsFound;
  AxisLandmarks: AxisLandmarks;
  CandidateView: CandidateView;
  Card: Card;
  CardsChanged: CardsChanged;
  CheckFinding: CheckFinding;
  CheckJob: CheckJob;
  CheckPicture: CheckPicture;
  CheckResult: CheckResult;
  ConfidenceView: ConfidenceView;
  CorrectByHand: CorrectByHand;
  CoverageView: CoverageView;
  CutHull: CutHull;
  DecomposeJob: DecomposeJob;
  DecomposeOptions: DecomposeOptions;
  DeleteRule: DeleteRule;
  DismissSpanning: DismissSpanning;
  DropManualEdits: DropManualEdits;
  EditHeader: EditHeader;
  EditReceipt: EditReceipt;
  Event: Event;
  ExcludeAssets: ExcludeAssets;
  ExportJob: ExportJob;
  ExtractorSuggestion: ExtractorSuggestion;
  FamilyOffer: FamilyOffer;
  Fault: Fault;
  Figure: Figure;
  FindingView: FindingView;
  FolderEntry: FolderEntry;
  FolderView: FolderView;
  GoalCall: GoalCall;
  GoalResultView: GoalResultView;
  GoalView: GoalView;
  Guess: Guess;
  Hello: Hello;
  HistoryAct: HistoryAct;
  HistoryChanged: HistoryChanged;
  HistoryState: HistoryState;
  HistoryView: HistoryView;
  HullLabel: HullLabel;
  HullOfAsset: HullOfAsset;
  HullRef: HullRef;
  HullView: HullView;
  HullsOfAsset: HullsOfAsset;
  Job: Job;
  JobChanged: JobChanged;
  JobLine: JobLine;
  JobRequest: JobRequest;
  LabelHulls: LabelHulls;
  LabelJob: LabelJob;
  LabelSources: LabelSources;
  LanguageView: LanguageView;
  ManualEditView: ManualEditView;
  Mark: Mark;
  MoveRule: MoveRule;
  NearMiss: NearMiss;
  NearestView: NearestView;
  NewAssetsView: NewAssetsView;
  NewProject: NewProject;
  NextStep: NextStep;
  NonConvexView: NonConvexView;
  Operator: Operator;
  OrientView: OrientView;
  OutcomeChanged: OutcomeChanged;
  OutcomeView: OutcomeView;
  PreviewJob: PreviewJob;
  PreviewRequest: PreviewRequest;
  Problem: Problem;
  ProgramChanged: ProgramChanged;
  ProgramCheck: ProgramCheck;
  ProgramView: ProgramView;
  ProjectChanged: ProjectChanged;
  ProjectOfFamily: ProjectOfFamily;
  ProjectOfFolder: ProjectOfFolder;
  ProjectOfTour: ProjectOfTour;
  ProjectOfUpload: ProjectOfUpload;
  ProjectView: ProjectView;
  PropagationState: PropagationState;
  Reach: Reach;
  ReachChanged: ReachChanged;
  Reason: Reason;
  RebuildJob: RebuildJob;
  RecentProject: RecentProject;
  RenameLabel: RenameLabel;
  ReplyToQuestion: ReplyToQuestion;
  ReviewAssets: ReviewAssets;
  ReviewChoiceView: ReviewChoiceView;
  ReviewQuestionView: ReviewQuestionView;
  RuleLine: RuleLine;
  RuleView: RuleView;
  SelectRequest: SelectRequest;
  SelectionView: SelectionView;
  SetGoal: SetGoal;
  SetLandmarks: SetLandmarks;
  SetOrientation: SetOrientation;
  SetSteps: SetSteps;
  SetUp: SetUp;
  SetVocabulary: SetVocabulary;
  ShapeRow: ShapeRow;
  ShapesHeader: ShapesHeader;
  SimilarRequest: SimilarRequest;
  SimilarView: SimilarView;
  Start: Start;
  StartView: StartView;
  StepEdit: StepEdit;
  StepView: StepView;
  TakeBack: TakeBack;
  TraceLine: TraceLine;
  Unprepare: Unprepare;
  UploadReceipt: UploadReceipt;
  VocabularyLabel: VocabularyLabel;
  WriteProgram: WriteProgram;
}
/**
 * An action and its arguments by name, those that are left out missing. each: whether it is done to every connected
 * part separately; label: what new hulls are labelled, null for the label of what they are made of.
 */
export interface ActionCall {
  name: string;
  arguments?: {
    [k: string]: boolean | number | string;
  };
  each?: boolean;
  label?: string | null;
}
/**
 * An action as a form. title: what it does to a selection, as a command; key: that begins it, empty for none;
 * usage: its syntax; makes: whether new hulls can get a label; clashes: pairs of values that do not go together.
 */
export interface ActionForm {
  name: string;
  title: string;
  summary: string;
  key: string;
  icon: "delete" | "replace" | "add" | "merge" | "scale" | "shrink" | "shapes";
  usage: string;
  makes: boolean;
  arguments: Argument[];
  clashes: [ArgumentValue, ArgumentValue][];
}
/**
 * One argument of an action or an extractor. kind: one of some `words`, a `flag` that is there or not, the `file`
 * of a template, a `shape` (a primitive or a template), a `factor` above 0, a `length` above 0 [m], an `option` with a
 * length [m], a `text`, a `share` above 0 and at most 1, a `label`, a `base` extractor, or any `extractor`.
 *
 * title: its name in the form; wants: what it must be; words: longer texts for some choices; omitted: what happens
 * without it; usual: what a form begins with.
 */
export interface Argument {
  name: string;
  kind:
    | "words"
    | "flag"
    | "file"
    | "shape"
    | "factor"
    | "length"
    | "option"
    | "text"
    | "share"
    | "label"
    | "base"
    | "extractor";
  title: string;
  wants: string;
  choices: string[];
  words: {
    [k: string]: string;
  };
  omitted: string;
  required: boolean;
  usual: boolean | number | string | null;
}
/**
 * A value of an argument; null for any that is none of its choices.
 */
export interface ArgumentValue {
  name: string;
  value: boolean | number | string | null;
}
/**
 * An action as it is shown. text: as the language has it, with `as LABEL` where new hulls get a label; short: that
 * without the label; icon: the name of its picture.
 */
export interface ActionView {
  name: string;
  arguments: {
    [k: string]: boolean | number | string;
  };
  each: boolean;
  label: string | null;
  text: string;
  short: string;
  icon: "delete" | "replace" | "add" | "merge" | "scale" | "shrink" | "shapes";
}
/**
 * Say which hulls a rule selects on an asset, without being asked.
 */
export interface AnswerForRule {
  kind: "answer";
  rule: number;
  asset: string;
  select: string[];
}
/**
 * An answer, or a repair of a label that was confirmed or refused; id: to take it back.
 */
export interface AnswerView {
  id: string;
  kind: "answer" | "confirmed" | "rejected";
  asset: string;
  text: string;
}
/**
 * Label some hulls, given by name for each asset; null takes their labels away.
 */
export interface LabelHulls {
  kind: "label";
  hulls: {
    [k: string]: string[];
  };
  label: string | null;
}
/**
 * Set the labels that hulls can have, in the order of their colours.
 */
export interface SetVocabulary {
  kind: "vocabulary";
  labels: string[];
}
/**
 * Give a label of the vocabulary another name, wherever it is used.
 */
export interface RenameLabel {
  kind: "rename-label";
  old: string;
  new: string;
}
/**
 * Set the axis that points up in views and pictures of assets whose format does not say.
 */
export interface SetUp {
  kind: "up";
  up: "Y" | "Z";
}
/**
 * Set the steps of an asset, one a rule, in order. version: of the steps that were changed.
 */
export interface SetSteps {
  kind: "steps";
  asset: string;
  version: string;
  steps: StepEdit[];
}
/**
 * One step. select: names of hulls, [] for nothing here, null for open.
 */
export interface StepEdit {
  select: string[] | null;
  action: ActionCall;
}
/**
 * Put a rule at another place, in all demonstrations; rules count from 1.
 */
export interface MoveRule {
  kind: "move-rule";
  rule: number;
  to: number;
}
/**
 * Take a rule away, with its steps in all demonstrations.
 */
export interface DeleteRule {
  kind: "delete-rule";
  rule: number;
}
/**
 * Set the orientation directive; empty takes it away.
 */
export interface SetOrientation {
  kind: "orient";
  text: string;
}
/**
 * Set the orientation by landmarks; none takes it away. snap: whether it turns by quarter turns only.
 */
export interface SetLandmarks {
  kind: "landmarks";
  snap: boolean;
  pairs: AxisLandmarks[];
}
/**
 * A direction that goes from some hulls to others, each by their label; null for all hulls.
 */
export interface AxisLandmarks {
  axis: "+X" | "-X" | "+Y" | "-Y" | "+Z" | "-Z";
  start: string | null;
  end: string | null;
}
/**
 * Reply to a question. question: as it was asked; choice: the id of one of its choices, null for none of them.
 *
 * exceptions: hulls of a group that are something else, or all that are labelled where none of the choices fits;
 * selections, labels: where a result is wrong, the hulls that rules should have selected, by their numbers, and labels
 * that hulls should have; later: the question is snoozed.
 */
export interface ReplyToQuestion {
  kind: "reply";
  question: ReviewQuestionView;
  choice?: string | null;
  exceptions?: HullLabel[];
  selections?: {
    [k: string]: string[];
  };
  labels?: {
    [k: string]: string;
  };
  later?: boolean;
}
/**
 * A question. seconds: of a person; gain: assets that an answer makes right, as far as can be expected; hulls:
 * those in question; goals: texts of those that fail on a result.
 */
export interface ReviewQuestionView {
  id: string;
  kind: "group" | "repair" | "candidate" | "label" | "selection" | "orientation" | "result" | "demonstrate";
  text: string;
  seconds: number;
  gain: number;
  asset: string;
  rule: number | null;
  hulls: HullRef[];
  choices: ReviewChoiceView[];
  goals: string[];
}
/**
 * A hull of an asset. place: its position among the asset's own hulls.
 */
export interface HullRef {
  asset: string;
  hull: string;
  place: number;
}
/**
 * One reply. id: among those of its question; label: that the hulls then get; select: names of the hulls that the
 * rule then selects; sentence: that reading in words; orient: the directive that the family then gets.
 */
export interface ReviewChoiceView {
  id: string;
  text: string;
  label: string | null;
  select: string[] | null;
  sentence: string;
  orient: string | null;
}
/**
 * A hull and the label that it gets.
 */
export interface HullLabel {
  asset: string;
  hull: string;
  label: string;
}
/**
 * Take back an answer or a repair by its id.
 */
export interface TakeBack {
  kind: "take-back";
  id: string;
}
/**
 * Keep a goal under a name; null takes it away. was: the name that it had before, null for a new one.
 */
export interface SetGoal {
  kind: "goal";
  name: string;
  text: string | null;
  was?: string | null;
}
/**
 * Make a text the project's program. version: of the program that was changed.
 */
export interface WriteProgram {
  kind: "program";
  text: string;
  version: string;
}
/**
 * Cut a hull along a plane through `at` [m] across `across`, in the frame that the asset comes in.
 */
export interface CutHull {
  asset: string;
  kind: "cut";
  hull: string;
  /**
   * @minItems 3
   * @maxItems 3
   */
  at: [number, number, number];
  /**
   * @minItems 3
   * @maxItems 3
   */
  across: [number, number, number];
}
/**
 * Take back the last thing that was done to an asset before the program.
 */
export interface Unprepare {
  asset: string;
  kind: "unprepare";
}
/**
 * Say of hulls, given by name for each asset, that they span no parts: they are not found again.
 */
export interface DismissSpanning {
  kind: "dismiss-spanning";
  hulls: {
    [k: string]: string[];
  };
}
/**
 * Accept the results of some assets, or call them wrong; null takes that back.
 *
 * selections, labels: where the result of one asset is wrong, the hulls that rules should have selected, and labels
 * that hulls should have; goals: texts of those that fail on an accepted result, and do not count there.
 */
export interface ReviewAssets {
  kind: "review";
  ids: string[];
  verdict: ("accepted" | "wrong") | null;
  note?: string | null;
  selections?: {
    [k: string]: string[];
  };
  labels?: {
    [k: string]: string;
  };
  goals?: string[];
}
/**
 * Give some assets up, with the reason; null includes them again.
 */
export interface ExcludeAssets {
  kind: "exclude";
  ids: string[];
  reason: ("not of this family" | "not solved") | null;
}
/**
 * Add an edit by hand, on hulls by the names they have after the program and the edits before.
 */
export interface CorrectByHand {
  asset: string;
  kind: "correct";
  select: string[];
  action: ActionCall;
}
/**
 * Take all edits by hand away from an asset, so that it is what the program makes of it.
 */
export interface DropManualEdits {
  asset: string;
  kind: "drop-manual-edits";
}
/**
 * Run the program on all assets, or on some; those that are new are prepared before. rebuild: whether bodies of
 * these are rebuilt of which a hull spans parts, if the project's own were.
 */
export interface ApplyJob {
  kind: "apply";
  assets?: string[] | null;
  rebuild?: boolean;
}
/**
 * How sure the edits are now. assessment: null as soon as labels, answers or demonstrations changed, until that is
 * known again; assessing: whether that is being worked out.
 */
export interface AssessmentChanged {
  kind: "assessment";
  assessment: AssessmentView | null;
  assessing: boolean;
}
/**
 * A family as the last learning run left it. threshold: the probability from which on an asset is signed off;
 * signed_off, need_review, excluded: how many assets; unseen: those of the family that nobody looked at, as there are
 * too many, or they cannot be read; assets: the others in the family's order, empty while there is no program;
 * question: null where nothing is left to ask.
 */
export interface AssessmentView {
  threshold: number;
  signed_off: number;
  need_review: number;
  excluded: number;
  unseen: number;
  assets: ConfidenceView[];
  question: ReviewQuestionView | null;
}
/**
 * One asset. probability: that its edit is right; reasons: the weightiest first; state: whether it is signed off,
 * needs review, or is excluded; reviewed: whether a person demonstrated or accepted it.
 */
export interface ConfidenceView {
  asset: string;
  probability: number;
  reasons: Reason[];
  state: "signed" | "needs review" | "excluded";
  reviewed: boolean;
}
/**
 * Why an edit may be wrong.
 *
 * text: one sentence; hulls: names of those concerned, on the asset; rule: its number, from 1, where it is about one;
 * share: the probability, in 0..1, that the edit is wrong for this alone.
 */
export interface Reason {
  kind: "candidate" | "label" | "orientation" | "outlier" | "alarm" | "goal";
  text: string;
  hulls: string[];
  rule: number | null;
  share: number;
}
/**
 * An asset as it is prepared, in the frame it comes in.
 *
 * upright: the 16 numbers (row by row) of canonical_T_incoming, null for the identity; unturned: why the orientation
 * cannot turn it; y_up: whether, after the orientation, it turns Y up; version: of the steps, to be sent back with an
 * edit of them; contacts: pairs of names of hulls.
 */
export interface AssetView {
  asset: string;
  bodies: string[];
  hulls: HullView[];
  non_convex: NonConvexView[];
  has_visual: boolean;
  contacts: [string, string][];
  near_misses: NearMiss[];
  upright: number[] | null;
  unturned: string | null;
  y_up: boolean;
  steps: StepView[];
  version: string;
  manual_edits: ManualEditView[];
  prepared: string[];
}
/**
 * A hull, made of one of a mesh. vertices, faces: how many, of a round primitive those of its tessellation;
 * primitive: its kind if it is one; source: who gave the label; look: whether it was given, null for no label; parent:
 * the hull of the file that a new hull inherits from.
 */
export interface HullView {
  name: string;
  body: string;
  label: string | null;
  confidence: number | null;
  source: string | null;
  look: ("given" | "guessed" | "unsure") | null;
  volume: number;
  vertices: number;
  faces: number;
  primitive: ("box" | "cylinder" | "capsule" | "sphere" | "ellipsoid") | null;
  parent: string | null;
}
/**
 * A non-convex piece of collision geometry. reason: why it is no hull; surface: whether the packet has it.
 */
export interface NonConvexView {
  name: string;
  body: string;
  reason: string;
  surface: boolean;
}
/**
 * Two hulls, by name, with a gap [m] between them of less than three times the contact distance.
 */
export interface NearMiss {
  a: string;
  b: string;
  gap: number;
}
/**
 * One step of a demonstration. select: names of hulls, [] for none, null where it is left open.
 *
 * error: why the step cannot be replayed; made, removed: names of hulls, where it can.
 */
export interface StepView {
  select: string[] | null;
  action: ActionView;
  error: string | null;
  made: string[];
  removed: string[];
}
/**
 * An edit by hand that is replayed after the program.
 */
export interface ManualEditView {
  select: string[];
  action: ActionView;
}
/**
 * Assets that changed, for open pages to fetch anew; shapes: whether their hulls changed, too.
 */
export interface AssetsChanged {
  kind: "assets";
  assets: string[];
  shapes: boolean;
}
/**
 * What a folder or an upload holds, before a project is made of it.
 *
 * folder: where it lies; kinds: how many of which format, in words; assets: how many; read: how many of them were
 * looked at, the first ones. Of these, pieces: how many pieces and bodies have no hulls and can be decomposed; seen:
 * how many of these are bodies that are only seen, while others of their asset collide; bare: how many assets have
 * such pieces; divided: how many of these have a piece with several parts that are known; parts:
 * some names of these; broken: how many cannot be read; problem: why the first of them cannot be read;
 * left_out: whether a project gets these not. project: the folder that is offered for the new project.
 */
export interface AssetsFound {
  folder: string;
  kinds: string;
  assets: number;
  read: number;
  pieces: number;
  seen: number;
  bare: number;
  divided: number;
  parts: string[];
  broken: number;
  problem: string | null;
  left_out: boolean;
  project: string;
}
/**
 * An extractor that agrees with all demonstrations of a rule; belief: its share in 0..1; differs_on: assets where
 * it selects something else than the program's.
 */
export interface CandidateView {
  id: string;
  rule: number;
  extractor: string;
  sentence: string;
  size: number;
  belief: number;
  differs_on: string[];
}
/**
 * One asset in the gallery.
 *
 * hulls: how many, null until the asset is read or where it cannot be read. labels: for each hull, in order, its
 * place in the vocabulary, or one of `NO_LABEL` and `NO_PART`; confidence: as in `AssetStatus`, below 50 where it is
 * unsure.
 * after: how many hulls the output has; after_labels: like `labels`, empty where they are not known; stale: what
 * changed since the output was made; excluded: why it is given up; manual_edits: how many edits by hand.
 * sources: how many pieces and bodies have no hulls and can be decomposed; prepared: what was done before the program.
 * picture, edited_picture: the digest that the address of the thumbnail takes, null where there is none yet.
 * check: the digest of the output and of its inputs, null where there is no output; faults: what checks found, null
 * where it was not checked; goals: what is known of those of the project on the result.
 */
export interface Card {
  asset: string;
  hulls: number | null;
  labels: number[];
  confidence: number[];
  demonstrated: boolean;
  output: "none" | "edited" | "unchanged" | "failed";
  after: number | null;
  after_labels: number[];
  stale: string[];
  error: string | null;
  flags: string[];
  review: ("accepted" | "wrong") | null;
  note: string | null;
  excluded: ("not of this family" | "not solved") | null;
  manual_edits: number;
  sources: number;
  prepared: string[];
  picture: string | null;
  edited_picture: string | null;
  check: string | null;
  faults: Fault[] | null;
  goals: GoalResultView[];
}
/**
 * A rule of a check that does not hold. engine: whose limit it is, or null; new: whether the edit caused it.
 */
export interface Fault {
  rule: string;
  severity: "error" | "warning";
  engine: string | null;
  new: boolean;
}
/**
 * What is known of a goal on the result of an asset, as in `GoalStatus`; picture: the key of that of a failure.
 */
export interface GoalResultView {
  name: string;
  goal: string;
  outcome: ("passed" | "failed" | "untried" | "broken") | null;
  why: string;
  hulls: string[];
  before: ("passed" | "failed" | "untried" | "broken") | null;
  accepted: boolean;
  fails: boolean;
  is_open: boolean;
  picture: string | null;
}
/**
 * New and changed cards; gone: ids of assets that no longer exist.
 */
export interface CardsChanged {
  kind: "cards";
  cards: Card[];
  gone: string[];
}
/**
 * A fault with its text. hulls: those that it concerns, by their names in the output.
 */
export interface CheckFinding {
  rule: string;
  severity: "error" | "warning";
  engine: string | null;
  new: boolean;
  hulls: string[];
  text: string;
  remedy: string;
}
/**
 * Run all checks on the outputs of all assets, or try a goal on them that is not kept.
 */
export interface CheckJob {
  kind: "check";
  goal?: string | null;
}
/**
 * A picture. text: what it shows; source: itself, as an address `data:…`.
 */
export interface CheckPicture {
  text: string;
  source: string;
}
/**
 * The result of one part of a check. gone: how many findings about the asset the output no longer has; notes: what
 * could not be measured, and why; cell: the resolution [m]; pictured: whether there are pictures of it.
 */
export interface CheckResult {
  part: "engines" | "physics" | "clearance" | "fit";
  figures: Figure[];
  findings: CheckFinding[];
  gone: number;
  notes: string[];
  cell: number | null;
  pictured: boolean;
}
/**
 * A figure before and after the edit; null where it is not known.
 */
export interface Figure {
  what: string;
  unit: "m" | "m/s" | "kg" | "l" | "%" | "°" | "";
  before: number | null;
  after: number | null;
}
/**
 * What an extractor selects on every asset, by positions of the asset's own hulls; in very large families on those
 * assets that learning looks at.
 */
export interface CoverageView {
  assets: {
    [k: string]: number[];
  };
}
/**
 * Make hulls for pieces and bodies that have none.
 */
export interface DecomposeJob {
  method?: ("coacd" | "vhacd") | null;
  by?: "whole" | "parts";
  most?: number | null;
  threshold?: number | null;
  kind: "decompose";
  assets: string[];
}
/**
 * How hulls are made of what has none. method: the tool that makes them, null for what made those of the project's
 * other assets, else CoACD, whatever the rest says; by: of each piece as a whole, or of each of its parts by itself,
 * where these are known; most: hulls of a piece; threshold: of CoACD, the concavity at which splitting stops; null is
 * what the tool takes by itself.
 */
export interface DecomposeOptions {
  method?: ("coacd" | "vhacd") | null;
  by?: "whole" | "parts";
  most?: number | null;
  threshold?: number | null;
}
/**
 * The header of a packet of an edited asset: all of its hulls, with the shapes of those that the asset has not.
 *
 * made, removed: names of hulls, compared with the asset as it comes; changed: of those that have another shape under
 * the same name, as a format writes it that has no new names; trace: what each rule did; findings: of the
 * check of legality; volume: the sum over hulls before and after [m^3].
 */
export interface EditHeader {
  rows: ShapeRow[];
  hulls: HullView[];
  made: string[];
  removed: string[];
  changed: string[];
  note: string | null;
  trace: TraceLine[];
  findings: FindingView[];
  flags: string[];
  /**
   * @minItems 2
   * @maxItems 2
   */
  volume: [number, number];
  contacts: [string, string][];
}
/**
 * One shape of a packet, a hull, a non-convex piece or a visual surface; vertices, faces: how many.
 */
export interface ShapeRow {
  name: string;
  vertices: number;
  faces: number;
}
/**
 * What one rule did. selected, made: names of hulls; note: what a user should know.
 */
export interface TraceLine {
  rule: number;
  selected: string[];
  made: string[];
  note: string | null;
}
/**
 * A finding of a check about a hull, or, without one, about the whole mesh.
 */
export interface FindingView {
  severity: "error" | "warning" | "note";
  text: string;
  hull: string | null;
}
/**
 * An edit is on disk. message: what was done, in words; nothing: whether there was nothing to do.
 */
export interface EditReceipt {
  message: string;
  nothing?: boolean;
}
/**
 * No project is open; sent when a page connects.
 */
export interface Start {
  kind: "start";
  start: StartView;
}
/**
 * What the start page shows. places: folders to begin looking for assets in; tour: the folder that is offered for
 * the project of the guided tour.
 */
export interface StartView {
  version: string;
  recent: RecentProject[];
  families: FamilyOffer[];
  places: string[];
  tour: string;
}
/**
 * A project that was open before. assets: how many it had then; opened: when, as ISO 8601; gone: whether there is
 * no project in that folder any more; state: how far it was then, or why it cannot be read now, empty where that is
 * not known; picture: the name of one of its thumbnails, empty where there is none.
 */
export interface RecentProject {
  folder: string;
  name: string;
  assets: number;
  opened: string;
  gone: boolean;
  state: string;
  picture: string;
}
/**
 * A bundled family. about: what it is, in a line; project: the folder that is offered for it.
 */
export interface FamilyOffer {
  name: string;
  about: string;
  project: string;
}
/**
 * The whole state, sent when a page connects. tour: whether the page shows the guided tour; engines: the
 * titles of those whose limits can be checked, by name; merged_files: formats of which those in `merged_by` make one
 * hull a file; leave: whether the page can leave the project.
 */
export interface Hello {
  kind: "hello";
  version: string;
  project: ProjectView;
  cards: Card[];
  history: HistoryState;
  program: ProgramView;
  language: LanguageView;
  outcome: OutcomeView | null;
  learning: boolean;
  reach: Reach[];
  assessment: AssessmentView | null;
  assessing: boolean;
  jobs: Job[];
  tour: boolean;
  engines: {
    [k: string]: string;
  };
  merged_files: string[];
  merged_by: string[];
  leave: boolean;
}
/**
 * The project.
 *
 * rules: what is demonstrated, by rule; templates: hull templates that actions can name; propagation: the last one of
 * labels, null where there was none; new: assets that a run prepares first, null for none; problem: why the program
 * cannot be applied; lost: ids that files are kept for though there is no such asset; left_out: ids of assets that are
 * kept, but not as part of the family; up: as in the settings; ask_up: an asset on which to ask what is up, null where
 * that is known.
 */
export interface ProjectView {
  name: string;
  folder: string;
  vocabulary: VocabularyLabel[];
  orient: OrientView;
  contact: number | null;
  extremity: number | null;
  rules: RuleLine[];
  answers: AnswerView[];
  templates: string[];
  goals: GoalView[];
  propagation: PropagationState | null;
  next: NextStep;
  new: NewAssetsView | null;
  problem: string | null;
  lost: string[];
  left_out: string[];
  up: "" | "Y" | "Z";
  ask_up: string | null;
}
/**
 * A label of the vocabulary, or a class. text: as programs write it; color: `#rrggbb`, by its place; is_class:
 * whether it stands for hulls that steps take.
 */
export interface VocabularyLabel {
  name: string;
  text: string;
  color: string;
  is_class: boolean;
}
/**
 * The orientation. text: of the directive, empty for none; sentence: that in words.
 */
export interface OrientView {
  text: string;
  sentence: string;
  snap: boolean;
  pairs: AxisLandmarks[];
}
/**
 * A rule in the demonstrations. action: the first one; shown, nothing: assets where it selects hulls, or none.
 */
export interface RuleLine {
  rule: number;
  action: ActionView;
  shown: string[];
  nothing: string[];
}
/**
 * A goal of the project, or what a form comes to, with a proposal for its name. sentence: it in words; call: as a
 * form has it, null where it is none; error: why, where in the text, and what helps.
 */
export interface GoalView {
  name: string;
  text: string;
  sentence: string;
  call: GoalCall | null;
  error: string | null;
}
/**
 * A goal as a form has it. name: the word that begins it; arguments: texts, those that are left out missing.
 */
export interface GoalCall {
  name: string;
  arguments: {
    [k: string]: string;
  };
}
/**
 * The last propagation of labels. unused: how many labels people and files gave since; next: the asset that would
 * help most if it were labelled, null where it is labelled by now, or where all are.
 */
export interface PropagationState {
  unused: number;
  next: string | null;
}
/**
 * What to do next, in words. asset: the one to open; command: what to type; note: what helps to type it.
 */
export interface NextStep {
  kind:
    | "wait"
    | "decompose"
    | "label-all"
    | "label"
    | "check-labels"
    | "demonstrate"
    | "learn"
    | "answer"
    | "fix-program"
    | "apply"
    | "review"
    | "correct"
    | "export";
  text: string;
  asset: string | null;
  command: string | null;
  note: string | null;
}
/**
 * The assets that came after the others were prepared, so that a run prepares them first. ids: of all of them;
 * rebuilt: in how many hulls that span parts are looked for, and bodies rebuilt from a probability of
 * `min_confidence` on; unclear: why they are not decomposed, null where it is clear how.
 */
export interface NewAssetsView {
  ids: string[];
  rebuilt: number;
  min_confidence: number | null;
  unclear: string | null;
}
/**
 * The titles of what can be undone and redone next, None for nothing, and how much can be.
 */
export interface HistoryState {
  undo: string | null;
  redo: string | null;
  undoable: number;
  redoable: number;
}
/**
 * The accepted program. by_hand: a person wrote or changed it; outdated: what it was learned from changed since;
 * version: to be sent back with an edit of the text; error: why the file does not parse.
 */
export interface ProgramView {
  text: string;
  version: string;
  by_hand: boolean;
  outdated: boolean;
  labels: string[];
  orient_sentence: string;
  rules: RuleView[];
  error: string | null;
}
/**
 * A rule of a program, as text and as a sentence.
 */
export interface RuleView {
  rule: number;
  text: string;
  sentence: string;
}
/**
 * The language: actions (without Each, a switch in the page), operators, directions; goals.
 */
export interface LanguageView {
  actions: ActionForm[];
  operators: Operator[];
  directions: string[];
  goals: Operator[];
}
/**
 * An extractor's operator and its operands, for completion, or a goal and its arguments: `words`, an `extractor` or
 * a `text`, with their defaults as `omitted`; base: whether it is a base extractor.
 */
export interface Operator {
  name: string;
  usage: string;
  summary: string;
  base: boolean;
  arguments: Argument[];
}
/**
 * The outcome of a learning run. number: counts the runs; program: its text, null where there is none; looked_at:
 * how many assets the run looked at; unambiguous: whether the program is unambiguous; repairs: how many labels
 * are probably wrong.
 *
 * error: a message in place of an outcome. why, advice, nearest: for a rule without an extractor. stale: ids of
 * answers that no longer fit. overruled: assets whose accepted result no program keeps.
 */
export interface OutcomeView {
  number: number;
  status: "found" | "ambiguous" | "repair" | "none" | "timeout" | "error";
  program: string | null;
  looked_at: number;
  rules: RuleView[];
  unambiguous: boolean;
  candidates: CandidateView[];
  repairs: number;
  nearest: NearestView | null;
  why: string | null;
  advice: string[];
  stale: string[];
  overruled: string[];
  error: string | null;
}
/**
 * The extractor that comes nearest, for a rule without any that fits, and how it differs on one asset.
 */
export interface NearestView {
  rule: number;
  extractor: string;
  asset: string;
  extra: string[];
  missing: string[];
}
/**
 * What a program does on one asset. rules: for each rule the positions of the asset's own hulls that it selects, or
 * that the hulls it selects were made of; error: why it does not run there.
 */
export interface Reach {
  asset: string;
  rules: number[][];
  error: string | null;
}
/**
 * Work that takes long. done, total: of the things to do now; doing: what that is, empty where the title says it;
 * left: [s] that they may still take at this rate, null where that is not known; lines: what became of assets, at
 * most 200: those that failed first, then those that were prepared before.
 *
 * message: its result in a sentence; out: the folder that was written.
 */
export interface Job {
  id: string;
  kind: "read" | "apply" | "decompose" | "preview" | "rebuild" | "export" | "add" | "label" | "check" | "goal";
  title: string;
  done: number;
  total: number;
  doing: string;
  left: number | null;
  state: "running" | "done" | "failed" | "cancelled";
  message: string;
  lines: JobLine[];
  out: string | null;
}
/**
 * What became of one asset in a job. before: what was done to a new asset before the program, in sentences;
 * picture: the key of that of a goal that fails; body, hulls: one in which these hulls were found to span parts.
 */
export interface JobLine {
  asset: string;
  status: "done" | "edited" | "unchanged" | "failed" | "skipped";
  text: string;
  before: string[];
  picture: string | null;
  body: string | null;
  hulls: string[];
}
/**
 * The project as it is now.
 */
export interface ProjectChanged {
  kind: "project";
  project: ProjectView;
}
/**
 * What can be undone now; by: the page that did, undid or redid something. Changed settings and the names of
 * changed assets are sent before, their cards after it.
 */
export interface HistoryChanged {
  kind: "history";
  history: HistoryState;
  by: string | null;
}
/**
 * A learning run has started (`learning`), or its outcome is there.
 */
export interface OutcomeChanged {
  kind: "outcome";
  outcome: OutcomeView | null;
  learning: boolean;
}
/**
 * What the program does on all assets.
 */
export interface ReachChanged {
  kind: "reach";
  reach: Reach[];
}
/**
 * The accepted program as it is now.
 */
export interface ProgramChanged {
  kind: "program";
  program: ProgramView;
}
/**
 * A job as it stands.
 */
export interface JobChanged {
  kind: "job";
  job: Job;
}
/**
 * Copy outputs into a folder: those that are signed off, or all. folder: below the project, or absolute.
 */
export interface ExportJob {
  kind: "export";
  signed_only?: boolean;
  folder?: string;
}
/**
 * An extractor that selects what a person selected on an asset, or more. places: positions of what it selects.
 */
export interface ExtractorSuggestion {
  text: string;
  sentence: string;
  places: number[];
}
/**
 * A folder in another. project: whether it is a project.
 */
export interface FolderEntry {
  name: string;
  project: boolean;
}
/**
 * A folder of this machine. parent: the one it lies in, null at the root; entries: the folders in it by name, but
 * for hidden ones; more: how many are left out; files: how many files of assets and meshes lie in it itself.
 */
export interface FolderView {
  folder: string;
  parent: string | null;
  project: boolean;
  entries: FolderEntry[];
  more: number;
  files: number;
}
/**
 * What the program would select for a rule on an asset, after the steps demonstrated before it.
 */
export interface Guess {
  rule: number;
  action: ActionView;
  select: string[];
  sentence: string;
  error: string | null;
}
/**
 * What is undone at once. title, at: of the last of its changes, and when it was, as ISO 8601; changes: how many it
 * has; done: how many changes of the project are done after it.
 */
export interface HistoryAct {
  title: string;
  at: string;
  changes: number;
  done: number;
}
/**
 * What was done last and can be undone, and what was undone and can be redone, the first one first.
 */
export interface HistoryView {
  acts: HistoryAct[];
}
/**
 * A hull of an asset, both by name.
 */
export interface HullOfAsset {
  asset: string;
  hull: string;
}
/**
 * Some hulls of an asset, by name, and their positions in it.
 */
export interface HullsOfAsset {
  asset: string;
  hulls: string[];
  positions: number[];
}
/**
 * Make the hulls of one asset to be looked at, and keep none. assets: those that they may be made for then.
 */
export interface PreviewJob {
  method?: ("coacd" | "vhacd") | null;
  by?: "whole" | "parts";
  most?: number | null;
  threshold?: number | null;
  kind: "preview";
  asset: string;
  assets: string[];
}
/**
 * Find the hulls of all assets that span parts, or rebuild some of their bodies. bodies: these by asset, null to
 * find; every: whether they are all that were found, so that those of new assets are rebuilt likewise.
 */
export interface RebuildJob {
  kind: "rebuild";
  bodies?: {
    [k: string]: string[];
  } | null;
  every?: boolean;
}
/**
 * Label all hulls of the family from files, names, and the labels that there are, weighed together.
 */
export interface LabelJob {
  kind: "label";
}
/**
 * Where labels could come from. files: how many assets have a labels file with new labels; names: how many hulls
 * without a label have one in their name.
 */
export interface LabelSources {
  files: number;
  names: number;
}
/**
 * An error at a place in a text; line, column: from 1.
 */
export interface Mark {
  line: number;
  column: number;
  message: string;
}
/**
 * Make a project of the assets in a folder, which stay where they are. project: the folder to make; decompose: how
 * hulls are made of what has none, null to leave it as it is.
 */
export interface ProjectOfFolder {
  kind: "folder";
  folder: string;
  project: string;
  decompose?: DecomposeOptions | null;
}
/**
 * Make a project of the files that were sent, which come into its own folder; fields as in `ProjectOfFolder`.
 */
export interface ProjectOfUpload {
  kind: "upload";
  project: string;
  decompose?: DecomposeOptions | null;
}
/**
 * Make a project of a bundled family, whose files are written into its own folder.
 */
export interface ProjectOfFamily {
  kind: "family";
  family: string;
  project: string;
}
/**
 * Make the project of the guided tour: the bundled tables with their labels.
 */
export interface ProjectOfTour {
  kind: "tour";
  project: string;
}
/**
 * What would an action do? steps: how many of the asset's own steps come before it; result: apply it to what the
 * program makes of the asset instead, as an edit by hand.
 */
export interface PreviewRequest {
  asset: string;
  steps?: number;
  select: string[];
  action: ActionCall;
  result?: boolean;
}
/**
 * An error. where: what it is about; conflict: the change was based on an old state; the page asks again.
 */
export interface Problem {
  message: string;
  where: string | null;
  remedy: string | null;
  conflict: boolean;
}
/**
 * Whether a text is a program, and its rules in words if so.
 */
export interface ProgramCheck {
  mark: Mark | null;
  rules: RuleView[];
  orient_sentence: string;
}
/**
 * What does an extractor select on an asset, after some of its steps, or before a rule of the program?
 */
export interface SelectRequest {
  asset: string;
  steps?: number;
  rule?: number | null;
  extractor: string;
}
/**
 * The names of the hulls that an extractor selects on an asset; mark: what is wrong with its text.
 */
export interface SelectionView {
  select: string[];
  sentence: string;
  mark: Mark | null;
}
/**
 * The header of a packet of the asset's own shapes: hulls first, then non-convex pieces; or the visual surfaces.
 *
 * A packet is: length of the header as uint32; the header as UTF-8 JSON, padded with spaces to a multiple of four;
 * vertices of all rows as float32 (x, y, z) [m]; triangles of all rows as uint32 (three each, counted in their row).
 * Little-endian, all in the frame that the asset comes in.
 */
export interface ShapesHeader {
  rows: ShapeRow[];
}
/**
 * Which hulls look like some? assets: where to look besides the hulls' own assets; null: in these alone; step: from
 * 0 on, how much they may differ.
 */
export interface SimilarRequest {
  hulls: HullOfAsset[];
  assets?: string[] | null;
  step?: number;
}
/**
 * Hulls that look like those of the request, these included. step: the one that was taken; more: whether another
 * step may take more; unread: assets that could not be looked in; passed_over: how many more there are.
 */
export interface SimilarView {
  found: HullsOfAsset[];
  step: number;
  more: boolean;
  unread: string[];
  passed_over: number;
}
/**
 * An upload is stored. names: the paths of asset files; problems: why other assets were left out.
 */
export interface UploadReceipt {
  names: string[];
  problems?: string[];
}
