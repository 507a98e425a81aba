// The server's interface, one function a request.
import type {
  AnyEdit,
  AssetsFound,
  AssetView,
  CheckResult,
  CheckPicture,
  EditReceipt,
  EditHeader,
  FolderView,
  CoverageView,
  ExtractorSuggestion,
  GoalCall,
  GoalView,
  Guess,
  HistoryView,
  Job,
  JobRequest,
  LabelSources,
  NewProject,
  PreviewRequest,
  ProgramCheck,
  SelectionView,
  SelectRequest,
  ShapesHeader,
  SimilarRequest,
  SimilarView,
  StartView,
  UploadReceipt,
} from "../wire";
import { getBytes, getJson, postForBytes, postJson, putBytes, withQuery } from "./http";
import { readPacket, readPicture, type EditedPacket, type ShapesPacket } from "./packet";

export const api = {
  asset: (asset: string) => getJson<AssetView>("api/asset", { asset }),
  shapes: async (asset: string): Promise<ShapesPacket> =>
    readPacket<ShapesHeader>(await getBytes("api/shapes", { asset })),
  visual: async (asset: string): Promise<ShapesPacket> =>
    readPacket<ShapesHeader>(await getBytes("api/visual", { asset })),
  stage: async (asset: string, steps: number): Promise<EditedPacket> =>
    readPacket<EditHeader>(await getBytes("api/stage", { asset, steps })),
  result: async (asset: string, of: "program" | "output"): Promise<EditedPacket> =>
    readPacket<EditHeader>(await getBytes("api/result", { asset, of })),
  triedHulls: async (asset: string): Promise<EditedPacket> => readPacket<EditHeader>(await getBytes("api/hulls", { asset })),
  preview: async (request: PreviewRequest, stop?: AbortSignal): Promise<EditedPacket> =>
    readPacket<EditHeader>(await postForBytes("api/preview", request, stop)),
  select: (request: SelectRequest, stop?: AbortSignal) => postJson<SelectionView>("api/select", request, stop),
  generalise: (extractor: string, rule: number, stop?: AbortSignal) =>
    postJson<CoverageView>("api/generalise", { extractor, rule }, stop),
  similar: (request: SimilarRequest) => postJson<SimilarView>("api/similar", request),
  prepareSimilar: () => postJson<EditReceipt>("api/similar/prepare", {}),
  guesses: (asset: string) => getJson<Guess[]>("api/guesses", { asset }),
  picture: async (asset: string, rule: number, show: readonly string[]) =>
    readPicture(await getBytes("api/picture", { asset, rule, show })),
  thumbnail: (asset: string, of: "source" | "output", version: string) =>
    withQuery("api/thumbnail", { asset, of, v: version }),
  turned: (asset: string, orient: string, run: number) => withQuery("api/turned", { asset, orient, run }),
  withUp: (asset: string, up: "y" | "z", version: string) => withQuery("api/turned", { asset, up, version }),
  checked: (asset: string, part: CheckResult["part"], stop: AbortSignal) =>
    getJson<CheckResult>("api/checked", { asset, part }, stop),
  checkPictures: (asset: string, part: CheckResult["part"], unit: "m" | "mm", stop: AbortSignal) =>
    getJson<CheckPicture[]>("api/checked/pictures", { asset, part, unit }, stop),
  edit: (edit: AnyEdit) => postJson<EditReceipt>("api/edit", edit),
  undo: (to?: number) => postJson<EditReceipt>("api/undo", { to }),
  redo: (to?: number) => postJson<EditReceipt>("api/redo", { to }),
  history: () => getJson<HistoryView>("api/history"),
  learn: () => postJson<EditReceipt>("api/learn", {}),
  stopLearning: () => postJson<EditReceipt>("api/learn/stop", {}),
  checkProgram: (text: string, stop?: AbortSignal) => postJson<ProgramCheck>("api/program/check", { text }, stop),
  checkGoal: (call: GoalCall, stop?: AbortSignal) => postJson<GoalView>("api/goal/check", call, stop),
  extractorsFor: (asset: string, select: readonly string[]) => postJson<ExtractorSuggestion[]>("api/goal/extractors", { asset, select }),
  goalPicture: (asset: string, key: string) => withQuery("api/goal/picture", { asset, v: key }),
  labelSources: () => getJson<LabelSources>("api/labels/sources"),
  startJob: (request: JobRequest) => postJson<Job>("api/jobs", request),
  cancelJob: (id: string) => postJson<Job>("api/jobs/cancel", { id }),
  stageAssetFile: (path: string, file: Blob) => putBytes<UploadReceipt>("api/assets", { path }, file),
  takeAssets: () => postJson<UploadReceipt>("api/assets", {}),
  listFolder: (folder: string) => getJson<FolderView>("api/start/folder", { folder }),
  lookAtFolder: (folder: string, stop?: AbortSignal) => getJson<AssetsFound>("api/start/look", { folder }, stop),
  stageProjectFile: (path: string, file: Blob) => putBytes<UploadReceipt>("api/start/files", { path }, file),
  lookAtFiles: () => postJson<AssetsFound>("api/start/files", {}),
  clearFiles: () => postJson<UploadReceipt>("api/start/files/clear", {}),
  recentPicture: (folder: string, version: string) => withQuery("api/start/picture", { folder, v: version }),
  forgetProject: (folder: string) => postJson<StartView>("api/start/forget", { folder }),
  openProject: (folder: string) => postJson<EditReceipt>("api/start/open", { folder }),
  makeProject: (request: NewProject) => postJson<EditReceipt>("api/start/new", request),
  leaveProject: () => postJson<EditReceipt>("api/start/leave", {}),
};
